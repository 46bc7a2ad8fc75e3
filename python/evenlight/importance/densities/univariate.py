"""SciPy's continuous distributions of one variable, frozen or new-style."""

from __future__ import annotations

from typing import Any, Self

import numpy as np

from .density import LEAST, Array, Density

__all__ = ["Univariate"]


class Univariate(Density):
    """A density of one variable, drawn from by its quantiles.

    Parameters
    ----------
    distribution : object
        With `logpdf` and `ppf` (frozen distributions of `scipy.stats`) or `icdf` (its new ones).
    """

    name = "univariate"
    d = uniforms = 1

    def __init__(self, distribution: Any) -> None:
        self._distribution = distribution
        self._quantiles = getattr(distribution, "ppf", None) or distribution.icdf

    def sample(self, u: Array) -> Array:
        """Points of shape (n, 1), the quantiles of uniform numbers."""
        return np.asarray(self._quantiles(np.maximum(u, LEAST)))

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density at points of shape (n, 1)."""
        return np.asarray(self._distribution.logpdf(x[:, 0]))

    @classmethod
    def adopt(cls, thing: Any) -> Self | None:
        """Anything with quantiles and a density, or one of ours."""
        quantiles = callable(getattr(thing, "ppf", None)) or callable(getattr(thing, "icdf", None))
        if quantiles and callable(getattr(thing, "logpdf", None)) and not hasattr(thing, "d"):
            return cls(thing)
        return super().adopt(thing)
