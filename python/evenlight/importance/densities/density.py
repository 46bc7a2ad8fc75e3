"""What a density is: points from uniform numbers, and the logarithm of its value at points."""

from __future__ import annotations

from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

__all__ = ["LEAST", "Array", "Density", "weighted_moments"]

Array = NDArray[np.float64]

LEAST = 2.0**-65
"""Instead of 0, which points may have: where normal quantiles would be infinite."""


class Density:
    """A probability density on R^d that can be drawn from."""

    name: ClassVar[str]
    """Its name in the registry."""

    d: int
    """The number of coordinates of a point."""
    uniforms: int
    """How many uniform numbers make a point."""

    def sample(self, u: Array) -> Array:
        """Points, shape (n, d), from uniform numbers in [0, 1), shape (n, uniforms)."""
        raise NotImplementedError

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density, shape (n,), at points of shape (n, d)."""
        raise NotImplementedError

    def fitted(self, x: Array, weights: Array) -> Density:
        """One of the same kind that fits weighted points; those that cannot move return themselves."""
        return self

    @classmethod
    def adopt(cls, thing: Any) -> Self | None:
        """The density that stands for a foreign object, or None if there is none."""
        return thing if isinstance(thing, cls) else None


def weighted_moments(x: Array, weights: Array, scale: Array | None = None) -> tuple[Array, Array] | None:
    """Mean and covariance of weighted points, or None if they are worth too few points for a covariance.

    With a scale for every point, mean and covariance are those of Student's t: the scale multiplies the weights, but
    not the sum that the covariance is divided by.
    """
    total = float(weights.sum())
    if total == 0 or total**2 < 2 * x.shape[1] * float((weights**2).sum()):
        return None
    scaled = weights if scale is None else weights * scale
    mean = scaled @ x / scaled.sum()
    from_mean = x - mean
    covariance = (from_mean.T * scaled) @ from_mean / total
    return mean, covariance + 1e-9 * np.trace(covariance) / len(mean) * np.eye(len(mean))
