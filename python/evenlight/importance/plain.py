"""Importance sampling from one proposal: plain, or normalized by its own weights where the target lacks a constant."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np

from evenlight.estimate import Estimate, from_error, from_moments, plain
from evenlight.importance.densities import as_density
from evenlight.importance.diagnostics import effective_sample_size, tail_index
from evenlight.integrand import Integrand
from evenlight.moments import Moments
from evenlight.points import Independent

__all__ = ["importance_sampling"]


def importance_sampling(
    f: Callable[[Any], Any],
    target: Any,
    proposal: Any,
    *,
    n: int = 2**16,
    self_normalized: bool = False,
    seed: SupportsIndex = 0,
) -> Estimate:
    """Estimate the mean of f under a target density by sampling from another.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...).
    target : density
        p: see `as_density`. It need not be normalized if `self_normalized`.
    proposal : density
        q, above 0 wherever f p is not 0 (wherever p is, if `self_normalized`).
    n : int
        Function values.
    self_normalized : bool
        Whether to divide by the sum of the weights instead of n: for targets known up to a constant; biased by O(1/n).
    seed : int
        Same seed, same bits.

    Returns
    -------
    Estimate
        With `ess`, `largest_weight` and `tail_index` of the weights among the diagnostics.

    Raises
    ------
    ValueError
        If an argument is not as above.

    Notes
    -----
    The standard error of the ratio is that of its linearization: A. B. Owen, *Monte Carlo theory, methods and
    examples*, chapter 9.

    Examples
    --------
    >>> from evenlight.importance import Normal, importance_sampling
    >>> estimate = importance_sampling(lambda x: x[:, 0] ** 2, Normal([0.0]), Normal([0.0], 2.0), n=20_000)
    >>> bool(abs(estimate.value - 1) < 4 * estimate.standard_error)
    True
    """
    p, q = as_density(target), as_density(proposal)
    x = q.sample(Independent(q.uniforms, seed=seed).points(0, n))
    logs = p.logpdf(x) - q.logpdf(x)
    scale = float(logs.max()) if self_normalized else 0.0
    weights = np.exp(logs - scale)
    inside = weights > 0
    found = Integrand(f, None, "raise")(x[inside], 0)[0]
    y = np.zeros((n, *found.shape[1:]))
    y[inside] = found
    diagnostics = {
        "ess": effective_sample_size(weights),
        "largest_weight": float(weights.max()),
        "tail_index": tail_index(weights),
    }
    moments = Moments.of((y.T * weights).T)
    if not self_normalized:
        return from_moments(((1, moments),), method="importance", cost=float(n), diagnostics=diagnostics)
    ratio = plain(moments.mean / weights.mean())
    error = plain(np.sqrt((((y - ratio).T * weights) ** 2).sum(axis=-1).T) / weights.sum())
    estimate = Estimate(
        ratio, error, n, n, float(n), "self-normalized importance", diagnostics=diagnostics, degrees_of_freedom=n - 1.0
    )
    return from_error(estimate)
