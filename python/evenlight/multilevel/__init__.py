"""Multilevel Monte Carlo: most samples from cheap coarse simulations, few from fine ones. One method, one file.

A model is a `LevelSampler`: from a block of uniform numbers to the fine and the coarse value of the same simulation.
"""

from . import models
from .brownian import CONSTRUCTIONS, brownian_increments
from .debias import DEBIASING, debias
from .decay import Rates
from .functions import FunctionSampler
from .level import LevelRow
from .level_distribution import LevelDistribution
from .level_figure import level_figure
from .level_sampler import Coupled, Ladder, LevelSampler, MultiIndexSampler
from .level_table import MultilevelWarning, level_table
from .mlmc import mlmc
from .mlqmc import mlqmc
from .multi_index import multi_index

__all__ = [
    "CONSTRUCTIONS",
    "DEBIASING",
    "Coupled",
    "FunctionSampler",
    "Ladder",
    "LevelDistribution",
    "LevelRow",
    "LevelSampler",
    "MultiIndexSampler",
    "MultilevelWarning",
    "Rates",
    "brownian_increments",
    "debias",
    "level_figure",
    "level_table",
    "mlmc",
    "mlqmc",
    "models",
    "multi_index",
]
