"""Triangles in the plane or in space."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenlight.warp import TriangleRoot, Warp

from .domain import Array, Domain

__all__ = ["Triangle"]


class Triangle(Domain):
    """The points of a triangle.

    Parameters
    ----------
    corners : array_like, shape (3, k)
        In k = 2 or more dimensions.
    warp : evenlight.warp.Warp, optional
        From two uniform numbers to barycentric coordinates: `evenlight.warp.TriangleRoot` by default, which is
        continuous; `TriangleHeitz` distorts less.

    Raises
    ------
    ValueError
        If the corners have another shape, or lie on a line, or the warp leads elsewhere.

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

    def __init__(self, corners: Any, warp: Warp | None = None) -> None:
        self.corners = np.asarray(corners, np.float64)
        if self.corners.ndim != 2 or len(self.corners) != 3 or self.corners.shape[1] < 2:
            raise ValueError(f"corners must be three points of at least two coordinates, not {self.corners.shape}")
        sides = self.corners[1:] - self.corners[0]
        gram = sides @ sides.T
        self.volume = 0.5 * float(np.sqrt(max(0.0, np.linalg.det(gram))))
        if not self.volume > 1e-14 * float(np.trace(gram)):
            raise ValueError("the corners lie on a line")
        self.warp = TriangleRoot() if warp is None else warp
        if (self.warp.inputs, self.warp.outputs) != (2, 3):
            raise ValueError(f"warp must lead from the square to a triangle, not {self.warp}")

    def map(self, u: Array) -> Array:
        """Points of the triangle."""
        return np.asarray(self.warp.map(u) @ self.corners)
