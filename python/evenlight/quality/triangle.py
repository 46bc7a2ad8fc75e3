"""The discrepancy of points in a triangle: over parallelograms or trapezoids at its corners, exactly."""

from typing import Literal

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows

__all__ = ["triangle_discrepancy"]


def triangle_discrepancy(
    x: npt.ArrayLike,
    corners: npt.ArrayLike,
    *,
    sets: Literal["parallelograms", "trapezoids"] = "parallelograms",
) -> float:
    """Find the largest |points inside / n − area| over sets at the corners of a triangle.

    Parameters
    ----------
    x : array_like, shape (n, k)
        Points in the triangle.
    corners : array_like, shape (3, k)
        The corners of the triangle, in any space of k ≥ 2 dimensions.
    sets : str
        - "parallelograms": {p < s, q < t} for x = V + p (P − V) + q (Q − V), at each corner V (Brandolini et al. 2013;
          Basu and Owen 2015). For these there is a Koksma–Hlawka inequality.
        - "trapezoids": {p < s, p + q < t}, six families (Pillards and Cools 2004).

    Returns
    -------
    float
        In (0, 1]. Areas are in units of the triangle's, so that its shape and size do not matter.

    Raises
    ------
    ValueError
        If shapes do not fit, the corners are on a line, or a point is not in the triangle (up to 1e-9 of its size).

    Notes
    -----
    Exact up to rounding; coordinates that differ by less than 1e-14 count as ties. A sweep with a kinetic tree,
    O(n log² n); the direct way takes O(n²).

    Examples
    --------
    The centroid alone leaves much empty:

    >>> from evenlight import quality
    >>> corners = [[0, 0, 1], [2, 0, 1], [0, 3, 1]]
    >>> print(f"{quality.triangle_discrepancy([[2 / 3, 1, 1]], corners):.6f}")
    0.777778
    """
    points, vertices = as_rows(x), as_rows(corners, "corners")
    k = points.shape[1]
    if vertices.shape != (3, k) or k < 2:
        raise ValueError(
            f"corners must have shape (3, {max(k, 2)}) for points of {k} coordinates, not {vertices.shape}"
        )
    if not (np.isfinite(points).all() and np.isfinite(vertices).all()):
        raise ValueError("points and corners must be finite")
    edges = vertices[1:] - vertices[0]
    q, r = np.linalg.qr(edges.T)
    if abs(r[1, 1]) <= 1e-12 * np.abs(r).max():
        raise ValueError("the corners of a triangle must not be on a line")
    offsets = points - vertices[0]
    beside = np.linalg.solve(r, q.T @ offsets.T).T
    off_plane = np.abs(offsets - beside @ edges).max(axis=1) > 1e-9 * np.abs(edges).max()
    if off_plane.any():
        raise ValueError(f"point {int(off_plane.argmax())} is not in the plane of the triangle")
    barycentric = np.column_stack((1 - beside.sum(axis=1), beside))
    return _core.triangle_discrepancy(np.ascontiguousarray(barycentric), sets)[0]
