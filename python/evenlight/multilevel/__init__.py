"""Multilevel Monte Carlo: most samples from cheap coarse simulations, few from fine ones. One method, one file.

A model is a `LevelSampler`: from a block of uniform numbers to the fine and the coarse value of the same simulation.
"""

from .level_sampler import Coupled, Ladder, LevelSampler, MultiIndexSampler

__all__ = [
    "Coupled",
    "Ladder",
    "LevelSampler",
    "MultiIndexSampler",
]
