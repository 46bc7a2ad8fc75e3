"""The multivariate Student t density: a normal with heavier tails."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
from scipy import special, stats

from .density import LEAST, Array, Density, weighted_moments
from .normal import Normal

__all__ = ["StudentT"]

_FROZEN = type(stats.multivariate_t([0.0], 1.0))


class StudentT(Density):
    """Student's t with a location, a shape matrix and degrees of freedom: where a normal would miss the tails.

    A point takes d + 1 uniform numbers: a normal one, divided by the root of a chi-square over its degrees of freedom.

    Parameters
    ----------
    location : array_like, shape (d,)
        Its center.
    shape : array_like, shape (d, d), or float
        Positive definite; a number stands for that multiple of the identity.
    df : float
        Degrees of freedom, above 0.

    Raises
    ------
    ValueError
        If the shapes do not fit, the matrix is not positive definite or `df` not above 0.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import StudentT
    >>> StudentT([0.0], 1.0, df=1).logpdf(np.zeros((1, 1))).round(4)  # Cauchy: -log(pi)
    array([-1.1447])
    """

    name = "student_t"

    def __init__(self, location: Any, shape: Any = 1.0, df: float = 5.0) -> None:
        if not df > 0:
            raise ValueError(f"degrees of freedom must be above 0, not {df}")
        self._normal = Normal(location, shape)
        self.location, self.shape, self.df = self._normal.mean, self._normal.covariance, float(df)
        self.d = self._normal.d
        self.uniforms = self.d + 1
        half = 0.5 * (self.df + self.d)
        self._constant = float(
            special.gammaln(half)
            - special.gammaln(0.5 * self.df)
            - 0.5 * self.d * np.log(self.df * np.pi)
            - np.log(np.diag(self._normal.root)).sum()
        )

    def sample(self, u: Array) -> Array:
        """Points from uniform numbers, the last of which makes the length."""
        steps = self._normal.sample(u[:, : self.d]) - self.location
        chi_square = 2.0 * special.gammaincinv(0.5 * self.df, np.maximum(u[:, self.d], LEAST))
        return np.asarray(self.location + steps * np.sqrt(self.df / chi_square)[:, np.newaxis])

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density at points."""
        return np.asarray(self._constant - 0.5 * (self.df + self.d) * np.log1p(self._normal.squares(x) / self.df))

    def fitted(self, x: Array, weights: Array) -> StudentT:
        """A step towards the most likely location and shape for weighted points, with the same degrees of freedom."""
        scale = (self.df + self.d) / (self.df + self._normal.squares(x))
        moments = weighted_moments(x, weights, scale)
        return self if moments is None else StudentT(*moments, self.df)

    @classmethod
    def adopt(cls, thing: Any) -> Self | None:
        """A frozen `scipy.stats.multivariate_t`, or one of ours."""
        if isinstance(thing, _FROZEN):
            return cls(thing.loc, thing.shape, thing.df)
        return super().adopt(thing)
