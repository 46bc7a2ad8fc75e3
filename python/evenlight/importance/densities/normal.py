"""The multivariate normal density."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from scipy import linalg, special, stats

from .density import LEAST, Array, Density, weighted_moments

__all__ = ["Normal"]

_FROZEN = type(stats.multivariate_normal(0.0, 1.0))
_BLOCK = 8192  # points whose differences from the mean stay in the cache


class Normal(Density):
    """Normal with a mean and a covariance matrix: the usual component of mixtures.

    Parameters
    ----------
    mean : array_like, shape (d,)
        Its center.
    covariance : array_like, shape (d, d), or float
        Positive definite; a number stands for that multiple of the identity.

    Raises
    ------
    ValueError
        If the shapes do not fit, or the covariance is not positive definite.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import Normal
    >>> Normal([0, 0], 1.0).logpdf(np.zeros((1, 2))).round(4)
    array([-1.8379])
    """

    name = "normal"

    def __init__(self, mean: Any, covariance: Any = 1.0) -> None:
        self.mean = np.atleast_1d(np.asarray(mean, np.float64))
        self.d = self.uniforms = len(self.mean)
        matrix = np.asarray(covariance, np.float64)
        self.covariance: Array = np.asarray(matrix * np.eye(self.d) if matrix.ndim == 0 else matrix, np.float64)
        if self.mean.ndim != 1 or self.covariance.shape != (self.d, self.d):
            raise ValueError(
                f"a mean of shape {self.mean.shape} and a covariance of {self.covariance.shape} do not fit"
            )
        try:
            self.root: Array = np.asarray(np.linalg.cholesky(self.covariance), np.float64)
        except np.linalg.LinAlgError:
            raise ValueError("the covariance is not positive definite") from None
        self._inverse_root: Array = linalg.solve_triangular(self.root, np.eye(self.d), lower=True)
        self._standard_mean: Array = self._inverse_root @ self.mean[:, np.newaxis]
        self._constant = -0.5 * self.d * np.log(2 * np.pi) - float(np.log(np.diag(self.root)).sum())

    def sample(self, u: Array) -> Array:
        """Points from uniform numbers, by normal quantiles and the Cholesky factor."""
        return np.asarray(self.mean + special.ndtri(np.maximum(u, LEAST)) @ self.root.T)

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density at points."""
        return np.asarray(self._constant - 0.5 * self.squares(x))

    def squares(self, x: Array) -> Array:
        """Squared distances from the mean, in units of the covariance (Mahalanobis)."""
        found = np.empty(len(x))
        for start in range(0, len(x), _BLOCK):
            standard = self._inverse_root @ x[start : start + _BLOCK].T
            standard -= self._standard_mean
            np.einsum("ij,ij->j", standard, standard, out=found[start : start + _BLOCK])
        return found

    def fitted(self, x: Array, weights: Array) -> Normal:
        """The normal with mean and covariance of weighted points."""
        moments = weighted_moments(x, weights)
        return self if moments is None else Normal(*moments)

    @classmethod
    def adopt(cls, thing: Any) -> Self | None:
        """A frozen `scipy.stats.multivariate_normal`, or one of ours."""
        if isinstance(thing, _FROZEN):
            return cls(thing.mean, thing.cov)
        return super().adopt(thing)
