"""Multiple importance sampling with a heuristic: fixed numbers of points of several proposals, weighted together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, SupportsIndex

import numpy as np

from evenlight.estimate import Estimate, from_error, plain
from evenlight.importance import heuristics
from evenlight.importance.mixture import Mixture
from evenlight.importance.mixture_estimate import values
from evenlight.importance.strata import Strata
from evenlight.integrand import Integrand
from evenlight.points import Independent

__all__ = ["multiple_importance"]


def multiple_importance(
    f: Callable[[Any], Any],
    target: Any,
    proposals: Sequence[Any],
    *,
    counts: Sequence[int],
    heuristic: str = "balance",
    seed: SupportsIndex = 0,
) -> Estimate:
    """Estimate the mean of f under a target density from given numbers of points of several proposals.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...).
    target : density
        p, normalized: see `as_density`.
    proposals : sequence of densities
        q_1 to q_J; together they must reach wherever f p is not 0.
    counts : sequence of int
        Points of each, at least 2.
    heuristic : {"balance", "power", "cutoff", "maximum"}
        How proposals share a point. "balance" is the same as a mixture with weights in proportion to the counts.
    seed : int
        Same seed, same bits.

    Returns
    -------
    Estimate
        With a standard error from the spread within each proposal.

    Raises
    ------
    ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight.importance import Normal, multiple_importance
    >>> p = Normal([0.0])
    >>> beyond = lambda x: (x[:, 0] > 3).astype(float)
    >>> estimate = multiple_importance(beyond, p, [p, Normal([3.0])], counts=[1000, 9000], heuristic="power")
    >>> bool(abs(estimate.value / 1.3498980316e-3 - 1) < 0.05)
    True
    """
    mixture = Mixture(target, proposals)
    numbers = np.asarray(counts)
    if numbers.shape != (len(mixture),) or numbers.min() < 2:
        raise ValueError(f"counts must be {len(mixture)} numbers of at least 2, not {list(counts)}")
    n = int(numbers.sum())
    component = np.repeat(np.arange(len(mixture)), numbers)
    sample = mixture.at(component, Independent(mixture.uniforms - 1, seed=seed).points(0, n))
    shares = heuristics.weights(heuristic, sample.q * numbers)[np.arange(n), component]
    fp = values(Integrand(f, None, "raise"), sample)
    y = fp.reshape(n, -1) * (shares / sample.q[np.arange(n), component])[:, np.newaxis]
    strata = Strata.of(y, component, len(mixture))
    value = strata.means.sum(axis=0)
    error, degrees = strata.error(np.ones(len(mixture)))
    estimate = Estimate(
        value=plain(value.reshape(fp.shape[1:])),
        standard_error=plain(error.reshape(fp.shape[1:])),
        n=n,
        replicates=n,
        cost=float(n),
        method=f"multiple importance ({heuristic})",
        message="as many function values as asked",
        diagnostics={
            "counts": numbers,
            "shares": (strata.means / np.where(value, value, 1.0)).reshape(-1, *fp.shape[1:]),
        },
        degrees_of_freedom=degrees,
    )
    return from_error(estimate)
