"""Effective dimension: how many coordinates matter, and how many at a time."""

import math
from typing import NamedTuple, SupportsIndex

import numpy as np

from .pick_freeze import Array, Design, Integrand, Ratio, ratio, values

__all__ = ["EffectiveDimension", "effective_dimension"]

_MOST = 12
"""All 2^d sets of coordinates are looked at."""


class EffectiveDimension(NamedTuple):
    """Where a function's variance is, by its ANOVA decomposition."""

    truncation: int
    """The first so many coordinates, in their order, have the wanted share of the variance."""
    superposition: int
    """Effects of at most so many coordinates at a time have the wanted share."""
    mean_dimension: float
    """The mean size of an effect, weighted by variance: at least 1."""
    mean_dimension_error: float
    """Its standard error."""
    first: Ratio
    """The share of the first 1, 2, …, d coordinates, shape (d,), with standard errors."""
    orders: Ratio
    """The share of all effects of exactly 1, 2, …, d coordinates, shape (d,), with standard errors."""


def effective_dimension(
    f: Integrand,
    d: SupportsIndex,
    *,
    share: float = 0.99,
    n: SupportsIndex = 1024,
    replicates: SupportsIndex = 16,
    seed: SupportsIndex = 0,
) -> EffectiveDimension:
    """Estimate the effective dimension of a function in the truncation and in the superposition sense.

    Parameters
    ----------
    f : callable
        Takes a block of points, shape (n, d), in [0, 1); returns shape (n,).
    d : int
        The number of coordinates, at most 12.
    share : float
        The share of the variance that is wanted, in (0, 1).
    n : int
        Points of a replicate; a power of 2 is best. The function is evaluated n 2^d replicates times.
    replicates : int
        Independent randomizations, at least 2.
    seed : int
        The same seed gives the same bits.

    Returns
    -------
    EffectiveDimension
        Both dimensions (Caflisch, Morokoff and Owen 1997), the mean dimension (Liu and Owen 2006), and the shares that
        they come from with standard errors.

    Raises
    ------
    ValueError
        If a number has no meaning, f is not finite or has the wrong shape, or is constant.

    Notes
    -----
    The variance of the effects within a set u is the covariance of f at two points that share the coordinates u. All
    sets are estimated from the same points, each from two pairs; sums over sets of one size give the shares of the
    orders.

    Examples
    --------
    >>> from evenlight import quality
    >>> found = quality.effective_dimension(lambda x: x[:, 0] + x[:, 1] + 0.01 * x[:, 2], 3)
    >>> found.truncation, found.superposition, round(found.mean_dimension, 3)
    (2, 1, 1.0)
    """
    design = Design.checked(d, n, replicates, seed)
    if design.d > _MOST:
        raise ValueError(f"d must be at most {_MOST}, not {design.d}: all 2^d sets of coordinates are looked at")
    if not 0 < share < 1:
        raise ValueError(f"share must be in (0, 1), not {share}")
    within = np.array([_within(f, a, b) for a, b in design.pairs()])
    below = within[:, -1]
    if not below.mean() > 0:
        raise ValueError("f is constant: there is no variance to share")
    first = ratio(within[:, [(1 << j) - 1 for j in range(1, design.d + 1)]], below)
    by_order = _orders(within, design.d)
    orders = ratio(by_order, below)
    mean = ratio(by_order @ np.arange(1, design.d + 1), below)
    return EffectiveDimension(
        truncation=_reached(first.value, share),
        superposition=_reached(np.cumsum(orders.value), share),
        mean_dimension=float(mean.value),
        mean_dimension_error=float(mean.standard_error),
        first=first,
        orders=orders,
    )


def _reached(shares: Array, share: float) -> int:
    """The first place that has the share; the last one has all."""
    return int(np.argmax(np.append(shares[:-1] >= share, True))) + 1


def _within(f: Integrand, a: Array, b: Array) -> Array:
    """The variance of the effects within each set of coordinates; bit j of a set's number is coordinate j."""
    d = a.shape[1]
    shared = [(number >> np.arange(d) & 1).astype(bool) for number in range(1 << d)]
    found = np.stack([values(f, np.where(mask, a, b)) for mask in shared])
    found -= (found[0].mean() + found[-1].mean()) / 2
    # a point of set u shares u with a, and the other coordinates with b
    with_a = (found * found[-1]).mean(axis=1)
    with_b = (found * found[0]).mean(axis=1)
    within: Array = (with_a + with_b[::-1]) / 2
    return within


def _orders(within: Array, d: int) -> Array:
    """The variance of all effects of exactly 1, 2, …, d coordinates, for each replicate."""
    size = np.array([number.bit_count() for number in range(1 << d)])
    sums = np.stack([within[:, size == k].sum(axis=1) for k in range(1, d + 1)], axis=1)
    exact = np.zeros_like(sums)
    for k in range(1, d + 1):
        # an effect of j coordinates is within C(d − j, k − j) sets of k
        known = sum(exact[:, j - 1] * math.comb(d - j, k - j) for j in range(1, k))
        exact[:, k - 1] = sums[:, k - 1] - known
    return exact
