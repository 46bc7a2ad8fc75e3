"""Sobol' indices with honest errors: which coordinates a function's variance comes from."""

from typing import NamedTuple, SupportsIndex

import numpy as np

from .pick_freeze import Array, Design, Integrand, ratio, values

__all__ = ["SobolIndices", "sobol_indices"]


class SobolIndices(NamedTuple):
    """Shares of the variance, with the standard errors that the replicates show."""

    first_order: Array
    """The share that each coordinate has alone, shape (d,)."""
    total_order: Array
    """The share of all effects that each coordinate takes part in, shape (d,)."""
    first_order_error: Array
    """Standard errors of `first_order`, shape (d,)."""
    total_order_error: Array
    """Standard errors of `total_order`, shape (d,)."""
    mean: float
    """The integral of the function."""
    variance: float
    """The variance of the function."""


def sobol_indices(
    f: Integrand,
    d: SupportsIndex,
    *,
    n: SupportsIndex = 1024,
    replicates: SupportsIndex = 16,
    seed: SupportsIndex = 0,
) -> SobolIndices:
    """Estimate Sobol' indices of first and total order, with standard errors from independent replicates.

    Parameters
    ----------
    f : callable
        Takes a block of points, shape (n, d), in [0, 1); returns shape (n,).
    d : int
        The number of coordinates.
    n : int
        Points of a replicate; a power of 2 is best. The function is evaluated n (d + 2) replicates times.
    replicates : int
        Independent randomizations, at least 2.
    seed : int
        The same seed gives the same bits.

    Returns
    -------
    SobolIndices
        Indices, errors, mean and variance. (index − truth) / error nearly follows Student's t with replicates − 1
        degrees of freedom.

    Raises
    ------
    ValueError
        If a number has no meaning, f is not finite or has the wrong shape, or is constant.

    Notes
    -----
    Estimators of Saltelli et al. 2010 (first order, centered) and Jansen 1999 (total order) on Owen-scrambled Sobol'
    points of 2 d coordinates. Negative estimates of indices near 0 are left as they are.

    Examples
    --------
    >>> from evenlight import quality
    >>> found = quality.sobol_indices(lambda x: x[:, 0] + 2 * x[:, 1], 2)
    >>> found.first_order.round(3).tolist(), found.total_order.round(3).tolist()
    ([0.2, 0.8], [0.2, 0.8])
    """
    design = Design.checked(d, n, replicates, seed)
    first, total, means, variances = [], [], [], []
    for a, b in design.pairs():
        at_a, at_b = values(f, a), values(f, b)
        mean = (at_a.mean() + at_b.mean()) / 2
        mixed = np.stack([values(f, _with_column(a, b, j)) for j in range(design.d)])
        first.append(((at_b - mean) * (mixed - at_a)).mean(axis=1))
        total.append(((at_a - mixed) ** 2).mean(axis=1) / 2)
        means.append(mean)
        variances.append((((at_a - mean) ** 2).mean() + ((at_b - mean) ** 2).mean()) / 2)
    below = np.array(variances)
    if not below.mean() > 0:
        raise ValueError("f is constant: there is no variance to share")
    one, all_ = ratio(np.array(first), below), ratio(np.array(total), below)
    return SobolIndices(
        one.value, all_.value, one.standard_error, all_.standard_error, float(np.mean(means)), float(below.mean())
    )


def _with_column(a: Array, b: Array, j: int) -> Array:
    """The points a, with coordinate j of b."""
    mixed = a.copy()
    mixed[:, j] = b[:, j]
    return mixed
