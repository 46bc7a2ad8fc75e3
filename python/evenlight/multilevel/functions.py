"""Level samplers from plain functions, for models that are a few lines and for those written for other libraries."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_callable, integer
from evenlight.multilevel.level_sampler import Coupled

__all__ = ["FunctionSampler"]

Array = NDArray[np.float64]


class FunctionSampler:
    """A level sampler from a function of uniform numbers, or from one that draws its own random numbers.

    Parameters
    ----------
    f : callable
        ``f(level, u)`` with u of shape (n, dims(level)), or if `draws`, ``f(level, n, generator)`` as in the codes
        that follow Giles (2015), with a `numpy.random.Generator`. It returns fine and coarse values, shape (n,) or
        (n, k) each; what it returns as coarse on level 0 does not count.
    dims : int or callable, optional
        Uniform numbers per sample, or a function of the level.
    cost : callable, optional
        Cost of one sample, a function of the level; ``2**level`` by default.
    draws : bool
        Whether f draws its own numbers. The generator of a block follows from its first number: the same seed gives
        the same result, but points other than independent ones are of no use and refused.
    max_level : int, optional
        The finest level there is.
    exact : bool
        Whether that one is the quantity itself.
    name : str
        In messages.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight.multilevel import FunctionSampler, mlmc
    >>> def midpoints(level, u):  # the integral of exp(x y) over y by 2^l midpoints, averaged over x
    ...     def rule(n):
    ...         return np.exp(u * (np.arange(n) + 0.5) / n).mean(axis=1)
    ...     return rule(2**level), rule(2 ** (level - 1)) if level else np.zeros(len(u))
    >>> estimate = mlmc(FunctionSampler(midpoints), rmse=1e-3, seed=1)
    >>> bool(abs(estimate.value - 1.3179021514544) < 3e-3)
    True
    """

    def __init__(
        self,
        f: Callable[..., tuple[Any, Any]],
        *,
        dims: SupportsIndex | Callable[[int], int] = 1,
        cost: Callable[[int], float] | None = None,
        draws: bool = False,
        max_level: SupportsIndex | None = None,
        exact: bool = False,
        name: str = "function",
    ) -> None:
        check_callable("f", f)
        if exact and max_level is None:
            raise ValueError("exact=True says that the level max_level is exact; give max_level")
        self.name = name
        self.max_level = None if max_level is None else integer("max_level", max_level, 0)
        self.exact = exact
        self.keyed = draws
        self._f = f
        self._dims = dims if callable(dims) else integer("dims", dims, 1)
        self._cost = cost

    def dims(self, level: int) -> int:
        """Uniform numbers per sample; 1, for the key, of a function that draws its own."""
        if self.keyed:
            return 1
        return int(self._dims(level)) if callable(self._dims) else self._dims

    def cost(self, level: int) -> float:
        """Cost of one sample, fine and coarse."""
        return float(2**level if self._cost is None else self._cost(level))

    def sample(self, level: int, u: Array) -> Coupled:
        """The function's values."""
        if self.keyed:
            generator = np.random.default_rng(int(u[0, 0] * 2**53))
            fine, coarse = self._f(level, len(u), generator)
        else:
            fine, coarse = self._f(level, u)
        fine = np.asarray(fine, np.float64)
        return Coupled(
            fine, np.asarray(coarse, np.float64) if level else np.zeros_like(fine), len(u) * self.cost(level)
        )
