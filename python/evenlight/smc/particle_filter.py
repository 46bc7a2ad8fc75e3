"""One run of a particle filter, time by time; driven by random numbers, or by evenly spread points in sorted order.

With random numbers: N. J. Gordon, D. J. Salmond and A. F. M. Smith, IEE Proc. F 140(2), 107-113 (1993). With evenly
spread points: M. Gerber and N. Chopin, "Sequential quasi Monte Carlo", J. R. Stat. Soc. B 77(3), 509-579 (2015).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from evenlight.points import Engine, Independent
from evenlight.smc.numbers import StepNumbers
from evenlight.smc.resampling import RESAMPLING
from evenlight.smc.resampling.inverse_cdf import Indices
from evenlight.smc.sorts import SORTS
from evenlight.smc.state_space import Array, Proposal, StateSpaceModel
from evenlight.smc.weights import effective_size, normalized

__all__ = ["Generation", "ParticleFilter"]


class Generation(NamedTuple):
    """The particles at one time."""

    time: int
    states: Array
    """Shape (n, dims)."""
    weights: Array
    """Of sum 1, shape (n,)."""
    ancestors: Indices | None
    """Where each particle was one time before; None at the start, and if all stayed in their places."""
    log_increment: float
    """The logarithm of the estimated density of the observation, given those before."""


@dataclass(frozen=True)
class ParticleFilter:
    """The settings of a run; `generations` runs it."""

    model: StateSpaceModel
    observations: Any
    proposal: Proposal | None
    particles: int
    points: Engine
    sorted: bool
    """Whether particles are sorted, as evenly spread points need them, and resampled at every time."""
    resampling: str
    """The scheme."""
    threshold: float
    """If particles are not sorted: resample if the weights are worth less than this share of them."""
    seed: int

    def generations(self, replicate: int) -> Iterator[Generation]:
        """Run through all times."""
        left_out = 1 if self.sorted else 0
        moves = StepNumbers(self.points, self.particles, left_out + self.model.move_uniforms, self.seed, replicate)
        needed = 1 if self.resampling == "systematic" else self.particles
        draws = StepNumbers(Independent(1), needed, 1, self.seed, replicate, 0)
        states = self._init(moves.start(self.model.init_uniforms))
        weights, increment = normalized(self._log_weights(0, None, states), "time 0")
        yield Generation(0, states, weights, None, increment)
        for t in range(1, len(self.observations)):
            ancestors, kept = self._select(states, weights, draws.step(t - 1)[:, 0])
            previous = states if ancestors is None else states.take(ancestors, axis=0)
            states = self._move(t, previous, moves.step(t - 1)[:, left_out:])
            log_weights = self._log_weights(t, previous, states)
            weights, increment = normalized(log_weights if kept is None else log_weights + kept, f"time {t}")
            yield Generation(t, states, weights, ancestors, increment)

    def _select(self, states: Array, weights: Array, u: Array) -> tuple[Indices | None, Array | None]:
        """Ancestors, or none and the logarithms of weights (times n) that are kept.

        In sorted order, particle i descends from where number (i + u) / n falls, and point i of the sequence moves it:
        with the former for a coordinate, the points of a digital sequence are a net of one dimension more. (The
        sequence's own first coordinate is left out: that of Sobol' points is too regular a function of i.)
        """
        if self.sorted:
            order = SORTS["hilbert"].order(states)
            return order.take(RESAMPLING[self.resampling](weights.take(order), u, self.particles)), None
        if self.threshold < 1 and effective_size(weights) >= self.threshold * self.particles:
            with np.errstate(divide="ignore"):
                return None, np.log(weights) + math.log(self.particles)
        return RESAMPLING[self.resampling](weights, u, self.particles), None

    def _init(self, u: Array) -> Array:
        if self.proposal is None:
            return self._checked(self.model.init(u))
        return self._checked(self.proposal.init(u, self.observations[0]))

    def _move(self, t: int, previous: Array, u: Array) -> Array:
        if self.proposal is None:
            return self._checked(self.model.move(t, previous, u))
        return self._checked(self.proposal.move(t, previous, u, self.observations[t]))

    def _log_weights(self, t: int, previous: Array | None, states: Array) -> Array:
        y = self.observations[t]
        weights = np.asarray(self.model.log_observation(t, previous, states, y), np.float64)
        if weights.shape != (self.particles,):
            raise ValueError(f"log_observation must return shape ({self.particles},), not {weights.shape}")
        if self.proposal is None:
            return weights
        if previous is None:
            correction = self.model.log_init(states) - self.proposal.log_init(states, y)
        else:
            correction = self.model.log_move(t, previous, states) - self.proposal.log_move(t, previous, states, y)
        return np.asarray(weights + correction)

    def _checked(self, states: Any) -> Array:
        array = np.asarray(states, np.float64)
        if array.shape != (self.particles, self.model.dims):
            raise ValueError(f"states must have shape ({self.particles}, {self.model.dims}), not {array.shape}")
        return array
