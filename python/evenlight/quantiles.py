"""Quantiles of a function of random points: medians, tails, value at risk, with errors from replicates."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np

from evenlight.arguments import check_points, integer
from evenlight.estimate import Estimate, from_error, plain
from evenlight.integrand import Integrand

__all__ = ["quantile"]


def quantile(
    f: Callable[[Any], Any],
    points: Any,
    probability: Any,
    *,
    n: SupportsIndex,
    replicates: SupportsIndex = 16,
    domain: Any = None,
) -> Estimate:
    """Estimate the number that f at a random point stays below with a given probability.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,).
    points : evenlight.points.Engine
        With randomness to replicate; evenly spread points help as they do with integrals.
    probability : float or array_like of shape (k,)
        Above 0 and below 1. For tails, n min(probability, 1 - probability) should be 100 or more per replicate.
    n : int
        Function values in all, a multiple of `replicates`.
    replicates : int
        Independent randomizations, at least 2, whose own quantiles say how far that of all values may be off.
    domain : domain, optional
        As for `integrate`; its volume does not matter.

    Returns
    -------
    Estimate
        The quantile of all values, or k of them; the bias is of the order of replicates / n.

    Raises
    ------
    ValueError
        If an argument is not as above.

    Notes
    -----
    Z. T. Kaplan, Y. Li, M. K. Nakayama and B. Tuffin, "Randomized quasi-Monte Carlo for quantile estimation", Winter
    Simulation Conference (2019).

    Examples
    --------
    >>> import evenlight
    >>> from evenlight.points import Sobol
    >>> estimate = evenlight.quantile(lambda x: x.sum(axis=1), Sobol(2, seed=1), [0.125, 0.5], n=2**14)
    >>> estimate.value.round(2)
    array([0.5, 1. ])
    """
    check_points(points)
    total, copies = integer("n", n, 1), integer("replicates", replicates, 2)
    if total % copies:
        raise ValueError(f"n = {total} is no multiple of {copies} replicates")
    p = np.asarray(probability, np.float64)
    if p.ndim > 1 or not (p.size and p.min() > 0 and p.max() < 1):
        raise ValueError(f"probabilities must be above 0 and below 1, not {probability}")
    u = points.points(0, total // copies, replicates=copies).reshape(total, -1)
    values, _ = Integrand(f, domain, "raise")(u, 0, copies)
    if values.ndim != 1:
        raise ValueError(f"f must return one number for each point, not {values.shape[1:]}")
    values = values if domain is None else values / domain.volume
    each = np.quantile(values.reshape(copies, -1), p, axis=1, method="inverted_cdf").T
    estimate = Estimate(
        value=plain(np.quantile(values, p, method="inverted_cdf")),
        standard_error=plain(each.std(axis=0, ddof=1) / np.sqrt(copies)),
        n=total,
        replicates=copies,
        cost=float(total),
        method="quantile",
        message="as many function values as asked",
        diagnostics={"points": (repr(points),), "replicates": each},
        degrees_of_freedom=copies - 1.0,
    )
    return from_error(estimate)
