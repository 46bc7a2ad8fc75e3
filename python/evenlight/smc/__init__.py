"""Particles: filters, smoothers, samplers and arrays of Markov chains, driven by randomness or by evenly spread points.

Models and chains take their uniform numbers as an argument: with ``points=Sobol`` they come from scrambled nets, which
is sequential quasi-Monte Carlo and Array-RQMC.
"""

from .array_rqmc import array_rqmc
from .chains import CHAINS, AsianOptionChain, AutoregressiveChain, LindleyQueue, MarkovChain
from .filter import filter
from .kalman import Kalman, kalman
from .log_evidence import LogEvidence
from .models import MODELS, LinearGaussian, StochasticVolatility
from .optimal_proposal import OptimalProposal
from .resampling import RESAMPLING, resample
from .smooth import smooth
from .smoothers import SMOOTHERS
from .sorts import SORTS, Sort
from .state_space import Proposal, StateSpaceModel, normals
from .tempering import temper

__all__ = [
    "CHAINS",
    "MODELS",
    "RESAMPLING",
    "SMOOTHERS",
    "SORTS",
    "AsianOptionChain",
    "AutoregressiveChain",
    "Kalman",
    "LindleyQueue",
    "LinearGaussian",
    "LogEvidence",
    "MarkovChain",
    "OptimalProposal",
    "Proposal",
    "Sort",
    "StateSpaceModel",
    "StochasticVolatility",
    "array_rqmc",
    "filter",
    "kalman",
    "normals",
    "resample",
    "smooth",
    "temper",
]
