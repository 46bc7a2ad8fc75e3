"""The shape of a step: a covariance matrix of the target, as kernels on R^d use it."""

from __future__ import annotations

from typing import Any

import numpy as np

from .kernel import Array

__all__ = ["root_of", "spread"]


def root_of(covariance: Any) -> Array | None:
    """The Cholesky factor of a covariance matrix (d, d), or of variances (d,) as a diagonal one; None for None.

    Raises
    ------
    ValueError
        If it is neither, or not positive definite.
    """
    if covariance is None:
        return None
    matrix = np.asarray(covariance, np.float64)
    if matrix.ndim == 1:
        matrix = np.diag(matrix)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise ValueError(f"a covariance has the shape (d, d) or (d,), not {matrix.shape}")
    try:
        return np.asarray(np.linalg.cholesky(matrix), np.float64)
    except np.linalg.LinAlgError:
        raise ValueError("the covariance is not positive definite") from None


def spread(z: Array, root: Array | None, transposed: bool = False) -> Array:
    """Each row z times the root, or its transpose: root z has the covariance if z is standard normal."""
    if root is None:
        return z
    if len(root) != z.shape[1]:
        raise ValueError(f"the covariance is for {len(root)} dimensions, the chains have {z.shape[1]}")
    return z @ root if transposed else z @ root.T
