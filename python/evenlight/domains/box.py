"""Boxes: a finite interval in every coordinate."""

from __future__ import annotations

from typing import Any

import numpy as np

from .domain import Array, Domain

__all__ = ["Box"]


class Box(Domain):
    """All points between two corners.

    Parameters
    ----------
    low, high : array_like, shape (d,)
        Finite, and low < high in every coordinate.

    Raises
    ------
    ValueError
        If they are not.

    Examples
    --------
    >>> import evenlight
    >>> from evenlight.domains import Box
    >>> from evenlight.points import Sobol
    >>> estimate = evenlight.integrate(lambda x: x[:, 0] * x[:, 1], Sobol(2), n=4096, domain=Box([0, 0], [2, 3]))
    >>> bool(abs(estimate.value - 9) < 0.01)
    True
    """

    name = "box"

    def __init__(self, low: Any, high: Any) -> None:
        self.low, self.high = np.atleast_1d(np.asarray(low, np.float64)), np.atleast_1d(np.asarray(high, np.float64))
        if self.low.shape != self.high.shape or self.low.ndim != 1:
            raise ValueError(
                f"low and high must be lists of the same length, not {self.low.shape} and {self.high.shape}"
            )
        if not (np.isfinite(self.low).all() and np.isfinite(self.high).all() and (self.low < self.high).all()):
            raise ValueError("low must be below high, and both finite; for R^d take a Law")
        self.d = len(self.low)
        self.volume = float(np.prod(self.high - self.low))

    def map(self, u: Array) -> Array:
        """Points of the box."""
        return np.asarray(self.low + (self.high - self.low) * u)
