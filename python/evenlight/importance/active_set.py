"""Newton's method on a simplex: a quadratic model at a time, each solved exactly by an active-set method."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from evenlight.importance.densities.density import Array

__all__ = ["Objective", "minimize_on_simplex"]

_STEPS = 60


class Objective(Protocol):
    """A smooth convex function."""

    def value(self, x: Array) -> float:
        """Its value."""
        ...

    def derivatives(self, x: Array) -> tuple[float, Array, Array]:
        """Value, gradient and Hessian."""
        ...


def minimize_on_simplex(objective: Objective, start: Array, tolerance: float) -> Array:
    """Minimize a smooth convex function of x >= 0 with a fixed sum.

    Sequential quadratic programming: the step to the minimum of the quadratic model over the simplex, shortened until
    the function falls.
    Reference: J. Nocedal and S. J. Wright, *Numerical Optimization*, 2nd ed. (2006), chapters 16 and 18.

    Parameters
    ----------
    objective : Objective
        What to minimize.
    start : ndarray of float64, shape (s,)
        A feasible point.
    tolerance : float
        Stop where the model promises a decrease by less than this part of the value.

    Returns
    -------
    ndarray of float64, shape (s,)
        The minimum.
    """
    x = start.copy()
    for _ in range(_STEPS):
        value, gradient, hessian = objective.derivatives(x)
        step = minimize_quadratic(gradient, hessian, x) - x
        decrement = -float(gradient @ step)
        if decrement <= tolerance * value:
            break
        length = 1.0
        while objective.value(x + length * step) > value - 1e-4 * length * decrement and length > 1e-9:
            length *= 0.5
        x = x + length * step
    return x


def minimize_quadratic(gradient: Array, hessian: Array, x: Array) -> Array:
    """Minimize g (y - x) + (y - x) H (y - x) / 2 over y >= 0 with the sum of x, by a primal active-set method.

    A step that would leave the simplex ends at its face; at the minimum of a face the one coordinate comes back whose
    slope is best. So the model never rises, and no face is met twice.
    """
    y = x.copy()
    free = y > 0
    scale = float(np.abs(gradient).max())
    for _ in range(20 * len(x)):
        slopes = gradient + hessian @ (y - x)
        step, multiplier = _newton(slopes, hessian, free)
        falling = step < 0
        room = np.where(falling, -y / np.where(falling, step, -1.0), np.inf)
        longest = float(room.min())
        y = np.maximum(y + min(1.0, longest) * step, 0.0)
        if longest < 1.0:
            hit = room <= longest
            y[hit] = 0.0
            free &= ~hit
            continue
        gain = np.where(free, -np.inf, multiplier - slopes - hessian @ step)
        if gain.max() <= 1e-13 * scale:
            break
        free[gain.argmax()] = True
    return np.asarray(y * (x.sum() / y.sum()))


def _newton(slopes: Array, hessian: Array, free: NDArray[np.bool_]) -> tuple[Array, float]:
    """The step of the free coordinates that keeps their sum, and the slope that they have in common after it."""
    index = np.flatnonzero(free)
    block = hessian[np.ix_(index, index)]
    ridge = 1e-13 * max(float(np.trace(block)) / len(index), np.finfo(float).tiny)
    factor = linalg.cho_factor(block + ridge * np.eye(len(index)))
    ones = linalg.cho_solve(factor, np.ones(len(index)))
    slope = linalg.cho_solve(factor, slopes[index])
    multiplier = float(slope.sum() / ones.sum())
    step = np.zeros_like(slopes)
    step[index] = multiplier * ones - slope
    return step, multiplier
