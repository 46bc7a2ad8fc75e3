"""Random-walk Metropolis steps of many states at once, shaped by the particles: what tempering moves with."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from evenlight.smc.resampling.inverse_cdf import Indices
from evenlight.smc.state_space import Array, normals

__all__ = ["TemperedStates", "rescaled", "shape_of", "step"]

_BEST_ACCEPTANCE = 0.234  # G. O. Roberts, A. Gelman and W. R. Gilks, Ann. Appl. Probab. 7(1), 110-120 (1997)


class TemperedStates(NamedTuple):
    """States with the two logarithms that make up every tempered density."""

    x: Array
    """Shape (n, d)."""
    log_prior: Array
    """Shape (n,)."""
    log_likelihood: Array
    """Shape (n,)."""

    def take(self, rows: Indices) -> TemperedStates:
        """Some of the rows, or some of them repeatedly."""
        return TemperedStates(*(part.take(rows, axis=0) for part in self))


def step(
    states: TemperedStates, evaluate: Callable[[Array], TemperedStates], temperature: float, root: Array, u: Array
) -> tuple[TemperedStates, float]:
    """One step that leaves prior times likelihood^temperature invariant, and the share of proposals accepted.

    `root` times its transpose is the covariance of proposals; `u` has d + 1 uniform numbers for each state.
    """
    proposed = evaluate(states.x + normals(u[:, :-1]) @ root.T)
    with np.errstate(invalid="ignore", divide="ignore"):
        gain = proposed.log_prior - states.log_prior
        gain = gain + temperature * (proposed.log_likelihood - states.log_likelihood)
        accepted = np.log(u[:, -1]) < gain  # never where the proposal is impossible: its gain is -inf or NaN
    chosen = (np.where(accepted.reshape(-1, *[1] * (a.ndim - 1)), a, b) for a, b in zip(proposed, states, strict=True))
    return TemperedStates(*chosen), float(accepted.mean())


def shape_of(x: Array, weights: Array) -> Array:
    """The root of the covariance of proposals that suits weighted states, for a scale of 1: 2.38 / √d of their own."""
    deviations = x - weights @ x
    covariance = (deviations.T * weights) @ deviations
    d = x.shape[1]
    ridge = 1e-9 * float(np.trace(covariance)) / d + 1e-300
    return np.asarray(np.linalg.cholesky(covariance + ridge * np.eye(d)) * (2.38 / math.sqrt(d)))


def rescaled(scale: float, acceptance: float) -> float:
    """A scale that brings acceptance nearer to what is best for many coordinates."""
    return scale * math.exp(acceptance - _BEST_ACCEPTANCE)
