"""Pairs of points that share some coordinates, from randomized Sobol' points: what sensitivities are made of."""

import operator
from collections.abc import Callable, Iterator
from typing import NamedTuple, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

from evenlight import _core
from evenlight.arguments import check_callable

__all__ = ["Design", "Integrand", "Ratio", "ratio", "values"]

Array: TypeAlias = npt.NDArray[np.float64]
Integrand: TypeAlias = Callable[[Array], npt.ArrayLike]
"""Values, shape (n,), of a block of points, shape (n, d)."""


class Design(NamedTuple):
    """How many points, how often, and how they are randomized."""

    d: int
    n: int
    replicates: int
    seed: int

    @classmethod
    def checked(cls, d: SupportsIndex, n: SupportsIndex, replicates: SupportsIndex, seed: SupportsIndex) -> "Design":
        """Refuse numbers that have no meaning."""
        made = cls(*(operator.index(number) for number in (d, n, replicates, seed)))
        for name, least in (("d", 1), ("n", 2), ("replicates", 2), ("seed", 0)):
            if getattr(made, name) < least:
                raise ValueError(f"{name} must be at least {least}, not {getattr(made, name)}")
        return made

    def pairs(self) -> Iterator[tuple[Array, Array]]:
        """Two independent blocks of points, shape (n, d) each, for every replicate."""
        points = _core.PointSet("sobol", 2 * self.d, "owen", self.seed)
        out = np.empty((self.replicates, self.n, 2 * self.d))
        points.fill_replicates(self.seed, (0, self.n), self.replicates, out, 1)
        for block in out:
            yield np.ascontiguousarray(block[:, : self.d]), np.ascontiguousarray(block[:, self.d :])


class Ratio(NamedTuple):
    """Ratios of means, and their standard errors."""

    value: Array
    standard_error: Array


def ratio(above: Array, below: Array) -> Ratio:
    """Divide means over replicates; the error is that of the linearized ratio.

    Parameters
    ----------
    above : ndarray, shape (replicates, ...)
        Numerators.
    below : ndarray, shape (replicates,)
        Denominators.

    Returns
    -------
    Ratio
        Of shape (...).
    """
    value = above.mean(axis=0) / below.mean()
    residuals = (above - np.multiply.outer(below, value)) / below.mean()
    return Ratio(value, residuals.std(axis=0, ddof=1) / np.sqrt(len(below)))


def values(f: Integrand, x: Array) -> Array:
    """Evaluate an integrand on a block, and refuse what is not one finite number for each point."""
    check_callable("f", f)
    found = np.asarray(f(x), dtype=np.float64)
    if found.shape != (len(x),):
        raise ValueError(f"f must return shape ({len(x)},) for {len(x)} points, not {found.shape}")
    if not np.isfinite(found).all():
        raise ValueError(f"f is not finite at {x[int(np.argmin(np.isfinite(found)))].tolist()}")
    return found
