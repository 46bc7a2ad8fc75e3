"""Densities given as Python functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Self

import numpy as np

from .density import Array, Density

__all__ = ["Callables"]


class Callables(Density):
    """A density made of two functions.

    Parameters
    ----------
    d : int
        The number of coordinates of a point.
    sample : callable
        From uniform numbers, shape (n, uniforms), to points, shape (n, d).
    logpdf : callable
        From points, shape (n, d), to logarithms of the density, shape (n,); -inf where it is 0.
    uniforms : int, optional
        How many uniform numbers make a point; `d` by default.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import Callables
    >>> triangle = Callables(1, lambda u: np.sqrt(u), lambda x: np.log(2 * x[:, 0]))
    >>> triangle.sample(np.array([[0.25]]))
    array([[0.5]])
    """

    name = "callables"

    def __init__(
        self, d: int, sample: Callable[[Array], Any], logpdf: Callable[[Array], Any], uniforms: int | None = None
    ) -> None:
        self.d = int(d)
        self.uniforms = self.d if uniforms is None else int(uniforms)
        self._sample, self._logpdf = sample, logpdf

    def sample(self, u: Array) -> Array:
        """Points from uniform numbers."""
        return np.asarray(self._sample(u), np.float64).reshape(len(u), self.d)

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density at points."""
        return np.asarray(self._logpdf(x), np.float64).reshape(len(x))

    @classmethod
    def adopt(cls, thing: Any) -> Self | None:
        """Anything with `d`, `sample(u)` and `logpdf(x)`."""
        if all(hasattr(thing, name) for name in ("d", "sample", "logpdf")):
            return cls(thing.d, thing.sample, thing.logpdf, getattr(thing, "uniforms", None))
        return None
