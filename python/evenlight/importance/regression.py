"""Least squares with the proposals' densities as control variates, safe where they depend on each other."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy import linalg

from evenlight.importance.densities.density import Array

__all__ = ["CUTOFF", "Fit", "fit"]

CUTOFF = 1e-9
"""Singular values below this times the largest count as 0."""


class Fit(NamedTuple):
    """What a regression says."""

    beta: Array
    """Coefficients of the densities, shape (J,) or (J, k); of several solutions the shortest."""
    residuals: Array
    """What is left, of the shape of y."""
    rank: int
    """How many densities are independent of each other."""


def fit(y: Array, x: Array, weights: Array | None = None) -> Fit:
    """Minimize sum of weights (y - x beta)^2.

    Columns are scaled to length 1 first, so that a density much narrower than the others is not mistaken for nothing.

    Parameters
    ----------
    y : ndarray of float64, shape (n,) or (n, k)
        Values; every column is fitted by itself.
    x : ndarray of float64, shape (n, J)
        Densities.
    weights : ndarray of float64, shape (n,), optional
        1 by default.

    Returns
    -------
    Fit
        Coefficients, residuals and rank.
    """
    root = None if weights is None else np.sqrt(weights)
    matrix = x if root is None else x * root[:, np.newaxis]
    lengths = np.sqrt(np.einsum("ij,ij->j", matrix, matrix))
    lengths[lengths == 0] = 1.0
    values = y if root is None else (y.T * root).T
    scaled, rank = linalg.lstsq(matrix / lengths, values, cond=CUTOFF, check_finite=False)[0:3:2]
    beta = np.asarray((scaled.T / lengths).T)
    return Fit(beta, y - x @ beta, int(rank))
