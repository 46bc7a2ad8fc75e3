"""The singularity of He and Owen (2014): unbounded at a point inside, square-integrable by a hair."""

from __future__ import annotations

import math

import numpy as np
from scipy import integrate, linalg, special

from .problem import Array, Problem

__all__ = ["SingularPoint"]

_LEAST = 2.0**-65  # instead of 0, which points may have: where the quantile would be infinite


class SingularPoint(Problem):
    """|z - 1|^-2.4 for z normal with covariances 2^-|i - j|, in 5 dimensions; its variance is 0.7109642.

    40 % of the second moment lies within 0.01 of the singularity, where a sample falls with probability 3e-12: the
    variance seen in a sample is far too small.
    """

    name = "singular_point"
    kind = "singular"
    cite = "H. Y. He and A. B. Owen, arXiv:1411.3954 (2014)"
    least_dims = 5

    def __init__(self, d: int) -> None:
        super().__init__(d)
        if d != 5:
            raise ValueError(f"{self.name} has 5 dimensions, not {d}")
        covariance = 2.0 ** -np.abs(np.subtract.outer(np.arange(d), np.arange(d)))
        self._root = np.linalg.cholesky(covariance)
        self.exact = mean_of_power(covariance, np.ones(d), 2.4)

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        z = special.ndtri(np.maximum(x, _LEAST)) @ self._root.T
        return np.asarray(((z - 1) ** 2).sum(axis=1) ** -1.2)


def mean_of_power(covariance: Array, center: Array, gamma: float) -> float:
    """E |z - c|^-gamma for centered normal z: a gamma integral over E exp(-t |z - c|^2), by substitution t = e^s."""
    variances, vectors = linalg.eigh(covariance)
    offsets = (vectors.T @ center) ** 2

    def integrand(s: float) -> float:
        widths = 1 + 2 * math.exp(s) * variances
        exponent = gamma / 2 * s - float((math.exp(s) * offsets / widths).sum()) - float(np.log(widths).sum()) / 2
        return math.exp(exponent)

    pieces = [(-60.0, -10.0), (-10.0, 0.0), (0.0, 10.0), (10.0, 60.0)]
    total = sum(integrate.quad(integrand, *piece, epsabs=0, epsrel=1e-13, limit=400)[0] for piece in pieces)
    tail = integrand(60.0) / ((len(center) - gamma) / 2)  # from there on a plain exponential, however slow
    return float((total + tail) / special.gamma(gamma / 2))
