"""Nested expectations, E g(E[f | X]): the inner mean by more and more samples. Value of information is one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.brownian import normals
from evenlight.multilevel.level_sampler import Coupled, LevelSampler

from .option import normal_cdf
from .row_blocks import row_blocks

__all__ = ["NestedExpectation", "partial_information"]

Array = NDArray[np.float64]


def best_decision(means: Array) -> Array:
    """The largest of the means of k decisions, shape (n, k) to (n,)."""
    return np.asarray(means.max(axis=1))


class NestedExpectation(LevelSampler):
    """E g(E[f(X, Y) | X]); level l takes first_samples * 2^l values of Y for each X.

    The coarse value is antithetic: the mean of g over both halves of the inner samples. Where g is linear near the
    inner mean the level difference is 0, so that its variance falls by 4 for smooth g and by 2.8 for a maximum;
    without, by 2.

    Parameters
    ----------
    inner : callable
        From uniform numbers of X, shape (n, 1, outer_dims), and of Y, shape (n, m, inner_dims), to f, shape (n, m, k).
    outer_dims, inner_dims : int
        Uniform numbers that X and Y take.
    g : callable
        From means, shape (n, k), to values, shape (n,). By default their largest: k decisions with expected benefits,
        of which the best is taken once X is known.
    first_samples : int
        Of Y on level 0.

    Raises
    ------
    ValueError
        If a number is too small, or a function returns another shape.

    Notes
    -----
    Cost: one unit per value of f. References: M. B. Giles and T. Goda, "Decision-making under uncertainty: using MLMC
    for efficient estimation of EVPPI", Stat. Comput. 29(4), 739-751 (2019); K. Bujok, B. M. Hambly and C. Reisinger,
    Methodol. Comput. Appl. Probab. 17(3), 579-604 (2015).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import NestedExpectation
    >>> model = NestedExpectation(lambda x, y: x + y, outer_dims=1, inner_dims=1, g=lambda mean: mean[:, 0] ** 2)
    >>> u = np.random.default_rng(1).random((4000, model.dims(6)))
    >>> round(float(model.sample(6, u).fine.mean()), 2)  # E (X + 1/2)² = 13 / 12
    1.08
    """

    max_level = None
    keyed = False

    def __init__(
        self,
        inner: Callable[[Array, Array], Any],
        *,
        outer_dims: SupportsIndex,
        inner_dims: SupportsIndex,
        g: Callable[[Array], Any] = best_decision,
        first_samples: SupportsIndex = 1,
    ) -> None:
        self.name = "nested expectation"
        self._inner, self._g = inner, g
        self.outer_dims = integer("outer_dims", outer_dims, 1)
        self.inner_dims = integer("inner_dims", inner_dims, 1)
        self.first_samples = integer("first_samples", first_samples, 1)

    def samples(self, level: int) -> int:
        """Values of Y for each X."""
        return self.first_samples << integer("level", level, 0)

    def dims(self, level: int) -> int:
        """The numbers of X, then those of all Y."""
        return self.outer_dims + self.samples(level) * self.inner_dims

    def cost(self, level: int) -> float:
        """Values of f."""
        return float(self.samples(level))

    def sample(self, level: int, u: Array) -> Coupled:
        """The function of the mean of all inner samples, and the mean of it over the halves."""
        numbers = np.asarray(u, np.float64)
        if numbers.ndim != 2 or numbers.shape[1] != self.dims(level):
            raise ValueError(f"u must have shape (n, {self.dims(level)}) on level {level}, not {numbers.shape}")
        n, half = len(numbers), self.samples(level) // 2
        fine, coarse = np.empty(n), np.zeros(n)
        for block in row_blocks(n, numbers.shape[1]):
            values = self._values(numbers[block])
            fine[block] = self._outer(values.mean(axis=1))
            if level:
                first, second = values[:, :half].mean(axis=1), values[:, half:].mean(axis=1)
                coarse[block] = 0.5 * (self._outer(first) + self._outer(second))
        return Coupled(fine, coarse, n * self.cost(level))

    def _values(self, u: Array) -> Array:
        x = u[:, np.newaxis, : self.outer_dims]
        y = u[:, self.outer_dims :].reshape(len(u), -1, self.inner_dims)
        values = np.asarray(self._inner(x, y), np.float64)
        if values.ndim != 3 or values.shape[:2] != y.shape[:2]:
            raise ValueError(f"inner must return shape ({y.shape[0]}, {y.shape[1]}, k), not {values.shape}")
        return values

    def _outer(self, means: Array) -> Array:
        values = np.asarray(self._g(means), np.float64)
        if values.shape != means.shape[:1]:
            raise ValueError(f"g must return shape {means.shape[:1]}, not {values.shape}")
        return values


@dataclass(frozen=True)
class _Benefits:
    """Of doing nothing, and of gaining X + Y."""

    mean: float
    spread: float
    noise: float

    def __call__(self, x: Array, y: Array) -> Array:
        gain = self.mean + self.spread * normals(x) + self.noise * normals(y)
        return np.concatenate([np.zeros_like(gain), gain], axis=2)


def partial_information(
    mean: float = 0.0, spread: float = 1.0, noise: float = 1.0, *, first_samples: SupportsIndex = 1
) -> tuple[NestedExpectation, float]:
    """A decision with a known answer: do nothing, or gain X + Y, after X has been seen.

    X is normal with that mean and standard deviation `spread`, Y with mean 0 and standard deviation `noise`.

    Returns
    -------
    model : NestedExpectation
        Of E max(0, E[X + Y | X]).
    exact : float
        Its mean. Less max(0, mean) it is the expected value of partial perfect information (EVPPI).

    Raises
    ------
    ValueError
        If a standard deviation is not above 0.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import partial_information
    >>> model, exact = partial_information()
    >>> round(exact, 6)
    0.398942
    >>> coupled = model.sample(6, np.random.default_rng(1).random((4000, model.dims(6))))
    >>> bool(abs(coupled.fine.mean() - exact) < 0.05)
    True
    """
    if not (spread > 0.0 and noise > 0.0):
        raise ValueError(f"spread and noise must be above 0, not {spread} and {noise}")
    benefits = _Benefits(mean, spread, noise)
    model = NestedExpectation(benefits, outer_dims=1, inner_dims=1, first_samples=first_samples)
    ratio = mean / spread
    density = math.exp(-0.5 * ratio**2) / math.sqrt(2.0 * math.pi)
    return model, spread * density + mean * normal_cdf(ratio)
