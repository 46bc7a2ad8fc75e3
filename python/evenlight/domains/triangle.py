"""Triangles in the plane or in space."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .domain import Array, Domain

__all__ = ["Triangle"]


def _root(u: Array) -> Array:
    """The usual map of the square to the triangle x, y >= 0, x + y <= 1: G. Turk, Graphics Gems, 24-28 (1990)."""
    root = np.sqrt(u[:, :1])
    return np.hstack([root * (1 - u[:, 1:]), root * u[:, 1:]])


class Triangle(Domain):
    """The points of a triangle.

    Parameters
    ----------
    corners : array_like, shape (3, k)
        In k = 2 or more dimensions.
    warp : callable, optional
        From uniform points, shape (n, 2), to points of the triangle x, y >= 0, x + y <= 1, that keeps areas; the usual
        square root by default.

    Raises
    ------
    ValueError
        If the corners have another shape, or lie on a line.

    Examples
    --------
    >>> import evenlight
    >>> from evenlight.domains import Triangle
    >>> from evenlight.points import Sobol
    >>> corner = Triangle([[0, 0], [1, 0], [0, 1]])
    >>> estimate = evenlight.integrate(lambda x: x[:, 0] * x[:, 1], Sobol(2), n=4096, domain=corner)
    >>> bool(abs(estimate.value - 1 / 24) < 1e-4)
    True
    """

    name = "triangle"
    d = 2

    def __init__(self, corners: Any, warp: Callable[[Array], Array] | None = None) -> None:
        self.corners = np.asarray(corners, np.float64)
        if self.corners.ndim != 2 or len(self.corners) != 3 or self.corners.shape[1] < 2:
            raise ValueError(f"corners must be three points of at least two coordinates, not {self.corners.shape}")
        self._sides = self.corners[1:] - self.corners[0]
        gram = self._sides @ self._sides.T
        self.volume = 0.5 * float(np.sqrt(max(0.0, np.linalg.det(gram))))
        if not self.volume > 1e-14 * float(np.trace(gram)):
            raise ValueError("the corners lie on a line")
        self._warp = _root if warp is None else warp

    def map(self, u: Array) -> Array:
        """Points of the triangle."""
        return np.asarray(self.corners[0] + self._warp(u) @ self._sides)
