"""Leapfrog steps of many chains, each with a number of steps of its own: what HMC and MALA move by."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .kernel import Array, LogDensity, WarmUp
from .metric import spread
from .target import DensityState, density_state, evaluate

__all__ = ["GradientState", "Trajectory", "gradient_state", "leapfrog", "tuned"]


@dataclass(frozen=True, eq=False)
class GradientState(DensityState):
    """Positions, the target and its gradient there."""

    gradient: Array
    """Of the log density, shape (chains, d)."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Where trajectories end, and by how much the energy has changed."""

    position: Array
    momentum: Array
    """In coordinates in which it is standard normal: the metric's root times it is the velocity."""
    log_density: Array
    gradient: Array
    energy_error: Array
    """The energy at the end less that at the start; infinite where the trajectory left the numbers or the target."""


def gradient_state(log_density: LogDensity, gradient: Callable[[Array], Array], position: Any) -> GradientState:
    """The state of chains at positions where target and gradient are finite."""
    state = density_state(log_density, position)
    slopes = gradient(state.position)
    if not np.isfinite(slopes).all():
        chain = int(np.argmin(np.isfinite(slopes).all(axis=1)))
        raise ValueError(f"the gradient is {slopes[chain].tolist()} at {state.position[chain].tolist()}")
    return GradientState(state.position, state.log_density, slopes)


def leapfrog(
    state: GradientState,
    momentum: Array,
    lengths: NDArray[np.int64],
    step_size: float,
    functions: tuple[LogDensity, Callable[[Array], Array], Array | None],
) -> Trajectory:
    """Advance chain i by lengths[i] leapfrog steps.

    The metric is the inverse of a covariance root root^T: with velocity root p, isotropic momentum p and forces root^T
    grad it needs no inverse. Explicit, reversible, volume-preserving; the energy error is of order step_size^2. The
    `functions` are the log density, its gradient and the root (None for the identity).
    """
    log_density, gradient, root = functions
    position, force = state.position.copy(), state.gradient.copy()
    p = momentum + 0.5 * step_size * spread(force, root, transposed=True)
    with np.errstate(over="ignore", invalid="ignore"):  # diverging trajectories end, and are rejected
        for step in range(int(lengths.max())):
            rows = np.flatnonzero((lengths > step) & np.isfinite(position).all(axis=1))
            if not len(rows):
                break
            position[rows] += step_size * spread(p[rows], root)
            rows = rows[np.isfinite(position[rows]).all(axis=1)]
            force[rows] = gradient(position[rows])
            share = np.where(lengths[rows] == step + 1, 0.5, 1.0)[:, None]
            p[rows] += share * step_size * spread(force[rows], root, transposed=True)
        kinetic = 0.5 * ((p**2).sum(axis=1) - (momentum**2).sum(axis=1))
        fine = np.isfinite(position).all(axis=1) & np.isfinite(kinetic) & np.isfinite(force).all(axis=1)
        values = np.full(len(p), -np.inf)
        if fine.any():
            values[fine] = evaluate(log_density, position[fine])
    error = np.where(fine, state.log_density - values + np.where(fine, kinetic, 0.0), np.inf)
    return Trajectory(position, p, values, force, error)


def tuned(kernel: Any, warm_up: WarmUp, target: float, first_step: float) -> Any:
    """The kernel with a step size nearer to the target acceptance, at times with the covariance so far.

    Windows 4, 8, 16, ... and the one after three quarters of the warm-up renew the covariance; each time, the step size
    begins anew with large changes, from the one that suits a standard normal (the expanding windows of Stan).
    """
    renewals = _renewals(warm_up.windows)
    if warm_up.window in renewals:
        return replace(kernel, step_size=first_step, covariance=warm_up.covariance())
    since = warm_up.window - max((window for window in renewals if window < warm_up.window), default=0)
    change = 3.0 * float(since) ** -0.6 * (warm_up.acceptance - target)
    return replace(kernel, step_size=kernel.step_size * float(np.exp(change)))


def _renewals(windows: int) -> list[int]:
    last = 3 * windows // 4
    return [2**k for k in range(2, 64) if 2 ** (k + 1) <= last] + ([last] if last >= 4 else [])
