"""What smoothers get: a whole run of a particle filter, and their own settings."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from evenlight.smc.particle_filter import Generation, ParticleFilter
from evenlight.smc.resampling.inverse_cdf import Indices
from evenlight.smc.state_space import Array

__all__ = ["History", "Smoothed", "lineage"]

Smoothed: TypeAlias = Iterator[tuple[int, Array, Array]]
"""Times in any order, each with states, shape (m, dims), and their weights of sum 1, shape (m,)."""


class History(NamedTuple):
    """A run and what is asked of it."""

    run: ParticleFilter
    replicate: int
    generations: list[Generation]
    trajectories: int
    """For backward sampling."""
    lag: int
    """For fixed lags."""


def lineage(generations: list[Generation], start: int, stop: int) -> Iterator[tuple[int, Indices]]:
    """Where the particles of time `start` were at each time before, down to `stop`."""
    places = np.arange(len(generations[start].states))
    yield start, places
    for t in range(start, stop, -1):
        ancestors = generations[t].ancestors
        places = places if ancestors is None else ancestors.take(places)
        yield t - 1, places
