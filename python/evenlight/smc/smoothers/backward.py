"""By backward sampling: whole trajectories drawn from the last time to the first, whatever their ancestors were.

The most accurate, at a cost of particles times trajectories; the model must have `log_move`. S. J. Godsill, A. Doucet
and M. West, "Monte Carlo smoothing for nonlinear time series", J. Am. Stat. Assoc. 99, 156-168 (2004).
"""

from __future__ import annotations

import numpy as np

from evenlight.points import Independent
from evenlight.smc.numbers import StepNumbers
from evenlight.smc.resampling.inverse_cdf import Indices
from evenlight.smc.state_space import Array, StateSpaceModel

from .history import History, Smoothed

__all__ = ["smoothed"]

_STREAM = 1  # of random numbers, besides those that select particles
_PAIRS = 1 << 17  # of particle and trajectory, weighed at once


def smoothed(history: History) -> Smoothed:
    """At each time the particle that leads to the next state of the trajectory, by weight times density of the move."""
    run, generations, count = history.run, history.generations, history.trajectories
    numbers = StepNumbers(Independent(1), count, 1, run.seed, history.replicate, _STREAM)
    equal = np.full(count, 1.0 / count)
    last = len(generations) - 1
    u = np.sort(numbers.step(0)[:, 0])
    sums = np.cumsum(generations[last].weights)
    following = generations[last].states.take(np.searchsorted(sums / sums[-1], u, side="right"), axis=0)
    yield last, following, equal
    for t in range(last - 1, -1, -1):
        generation = generations[t]
        with np.errstate(divide="ignore"):
            log_weights = np.log(generation.weights)
        draws = numbers.step(last - t)[:, 0]
        size = max(1, _PAIRS // len(log_weights))
        parts = [slice(start, start + size) for start in range(0, count, size)]
        chosen = [
            _choose(run.model, t + 1, (generation.states, log_weights), following[part], draws[part]) for part in parts
        ]
        following = generation.states.take(np.concatenate(chosen), axis=0)
        yield t, following, equal


def _choose(model: StateSpaceModel, t: int, particles: tuple[Array, Array], following: Array, u: Array) -> Indices:
    """A particle for each state that follows, by inversion."""
    states, log_weights = particles
    n, m = len(states), len(following)
    moves = model.log_move(t, np.tile(states, (m, 1)), np.repeat(following, n, axis=0)).reshape(m, n) + log_weights
    largest = moves.max(axis=1, keepdims=True)
    if not np.isfinite(largest).all():
        raise ValueError(f"log_move says that no particle leads to a state that one led to, at time {t}")
    sums = np.cumsum(np.exp(moves - largest), axis=1)
    return np.asarray((sums <= u[:, np.newaxis] * sums[:, -1:]).sum(axis=1))
