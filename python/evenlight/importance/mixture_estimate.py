"""Importance sampling from a mixture with optimal weights, and its densities as control variates."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, SupportsIndex

import numpy as np

from evenlight.arguments import check_points
from evenlight.estimate import Estimate, from_error, from_moments, plain
from evenlight.importance import regression
from evenlight.importance.densities.density import Array
from evenlight.importance.diagnostics import effective_sample_size, tail_index
from evenlight.importance.mixture import Mixture, Sample, counts
from evenlight.importance.optimal import OptimalMixture, optimal_mixture
from evenlight.importance.strata import Strata
from evenlight.integrand import Integrand
from evenlight.moments import Moments
from evenlight.points import Independent

__all__ = ["mixture_estimate"]


def mixture_estimate(
    f: Callable[[Any], Any],
    target: Any,
    proposals: Sequence[Any],
    *,
    alpha: Any = "optimal",
    beta: Literal["lstsq"] | None = "lstsq",
    floor: Any = None,
    n: int = 2**16,
    pilot: int | None = None,
    points: Any = None,
    replicates: int = 16,
    seed: SupportsIndex = 0,
) -> Estimate:
    """Estimate the mean of f under a target density by sampling from a mixture of others.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...).
    target : density
        p, normalized: see `as_density`.
    proposals : sequence of densities
        q_1 to q_J. Put the target among them: then no weight p / q exceeds 1 over its share (a defensive mixture).
    alpha : "optimal", "uniform" or array_like of shape (J,)
        Weights of the mixture. "optimal" learns them from a pilot sample of the uniform mixture.
    beta : "lstsq" or None
        Whether the densities are control variates, with coefficients by least squares on the very sample.
    floor : float or array_like, optional
        Least weights, for "optimal"; 0.1 / J by default.
    n : int
        Function values of the estimate, without the pilot's.
    pilot : int, optional
        Function values of the pilot sample, for "optimal"; n / 10 by default.
    points : evenlight.points.Engine, optional
        Randomized points of ``1 + d`` dimensions (of ``2 + d`` with a Student t), whose first chooses the component;
        the error is then that of `replicates`. By default independent points, in fixed numbers per component.
    replicates : int
        Of `points`; n is a multiple of it.
    seed : int
        Of the pilot sample and of the default points.

    Returns
    -------
    Estimate
        With `alpha`, `beta`, `counts` (points of each component), `ess`, `largest_weight` and `tail_index` (of the
        weights p / q), `variance` (n times that of the estimate), and of a pilot the `gap` among the diagnostics.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Estimates are mean of (f p - beta q) / q_alpha plus sum of beta. With coefficients by least squares the variance is
    at most that of any one component over its weight (A. Owen and Y. Zhou, JASA 95, 135-143, 2000), up to terms of
    order 1 / n. Weights: H. Y. He and A. B. Owen, arXiv:1411.3954 (2014).

    Examples
    --------
    >>> from evenlight.importance import Normal, mixture_estimate
    >>> p = Normal([0.0])
    >>> beyond = lambda x: (x[:, 0] > 3).astype(float)
    >>> estimate = mixture_estimate(beyond, p, [Normal([3.0]), Normal([-3.0]), p], n=10_000, seed=1)
    >>> bool(abs(estimate.value / 1.3498980316e-3 - 1) < 0.05)
    True
    """
    mixture = Mixture(target, proposals)
    integrand = Integrand(f, None, "raise")
    if beta not in ("lstsq", None):
        raise ValueError(f"beta must be 'lstsq' or None, not {beta!r}")
    if points is not None:
        check_points(points)
        if points.d != mixture.uniforms:
            raise ValueError(f"this mixture takes points of {mixture.uniforms} dimensions; {points!r} has {points.d}")
        if n < replicates:
            raise ValueError(f"n = {n} is less than the number of replicates, {replicates}")
    source = Independent(mixture.uniforms - 1, seed=seed)
    size = 0
    learned = None
    if isinstance(alpha, str) and alpha == "optimal":
        size = max(len(mixture), n // 10 if pilot is None else int(pilot))
        learned = _learn(mixture, integrand, source.replicate(0), size, floor, beta is not None)
    weights = _weights(alpha, learned, len(mixture))
    if points is None:
        estimate = _in_strata(mixture, integrand, weights, source.replicate(1), n, beta is not None)
    else:
        estimate = _in_replicates(mixture, integrand, weights, points, n // replicates, replicates, beta is not None)
    diagnostics = estimate.diagnostics | ({"gap": learned.gap} if learned else {})
    return from_error(estimate, cost=estimate.cost + size, diagnostics=diagnostics)


def _weights(alpha: Any, learned: OptimalMixture | None, components: int) -> Array:
    if learned is not None:
        return learned.alpha
    if isinstance(alpha, str):
        if alpha != "uniform":
            raise ValueError(f"alpha must be 'optimal', 'uniform' or an array, not {alpha!r}")
        return np.full(components, 1.0 / components)
    weights = np.asarray(alpha, np.float64)
    if weights.shape != (components,) or not (weights.min() >= 0 and abs(weights.sum() - 1) < 1e-9):
        raise ValueError(f"alpha must be {components} numbers, none negative, that add up to 1")
    return weights


def _learn(mixture: Mixture, integrand: Integrand, source: Any, size: int, floor: Any, cv: bool) -> OptimalMixture:
    """Optimal weights, from a pilot sample of the uniform mixture."""
    uniform = np.full(len(mixture), 1.0 / len(mixture))
    sample = _draw_in_strata(mixture, uniform, source, size)
    fp = values(integrand, sample)
    fp = fp if fp.ndim == 1 else fp.reshape(size, -1)
    return optimal_mixture(fp, sample.q, sample.q @ uniform, floor=floor, control_variates=cv)


def _draw_in_strata(mixture: Mixture, alpha: Array, source: Any, n: int) -> Sample:
    component = np.repeat(np.arange(len(mixture)), counts(alpha, n))
    return mixture.at(component, source.points(0, n))


def values(integrand: Integrand, sample: Sample) -> Array:
    """F p at the points of a sample; 0 where p is 0, whatever f is."""
    inside = sample.target > 0
    if not inside.any():
        return np.zeros(len(sample.x))
    y = (integrand(sample.x[inside], 0)[0].T * sample.target[inside]).T
    found = np.zeros((len(sample.x), *y.shape[1:]))
    found[inside] = y
    return found


def _reduced(sample: Sample, fp: Array, alpha: Array, cv: bool) -> tuple[Array, Array | None, int]:
    """Values whose mean is the estimate, shape (n, k); coefficients; how many degrees of freedom they took."""
    t = sample.q @ alpha
    y = fp.reshape(len(fp), -1) / t[:, np.newaxis]
    if not cv:
        return y, None, 0
    fitted = regression.fit(y, sample.q / t[:, np.newaxis])
    beta = fitted.beta.reshape(len(alpha), *fp.shape[1:])
    return fitted.residuals + fitted.beta.sum(axis=0), beta, fitted.rank - 1


def _in_strata(mixture: Mixture, integrand: Integrand, alpha: Array, source: Any, n: int, cv: bool) -> Estimate:
    sample = _draw_in_strata(mixture, alpha, source, n)
    fp = values(integrand, sample)
    y, beta, taken = _reduced(sample, fp, alpha, cv)
    strata = Strata.of(y, sample.component, len(alpha))
    error, degrees = strata.error(strata.numbers / n)
    error = plain((error * np.sqrt(n / max(n - taken, 1))).reshape(fp.shape[1:]))
    return Estimate(
        value=plain(y.mean(axis=0).reshape(fp.shape[1:])),
        standard_error=error,
        n=n,
        replicates=n,
        cost=float(n),
        method="mixture",
        message="as many function values as asked",
        diagnostics=_diagnostics(sample, alpha, beta) | {"variance": error**2 * n},
        degrees_of_freedom=degrees,
    )


def _in_replicates(
    mixture: Mixture, integrand: Integrand, alpha: Array, points: Any, rows: int, replicates: int, cv: bool
) -> Estimate:
    u = points.points(0, rows, replicates=replicates).reshape(-1, mixture.uniforms)
    sample = mixture.draw(alpha, u)
    fp = values(integrand, sample)
    y, beta, _ = _reduced(sample, fp, alpha, cv)
    means = y.reshape(replicates, rows, *fp.shape[1:]).mean(axis=1)
    moments = Moments.of(means)
    extra = {"variance": plain(moments.standard_error) ** 2 * len(u), "replicates": means, "points": (repr(points),)}
    return from_moments(
        ((rows, moments),),
        method="mixture",
        cost=float(len(u)),
        message="as many function values as asked",
        diagnostics=_diagnostics(sample, alpha, beta) | extra,
    )


def _diagnostics(sample: Sample, alpha: Array, beta: Array | None) -> dict[str, Any]:
    weights = sample.target / (sample.q @ alpha)
    return {
        "alpha": alpha,
        "beta": beta,
        "counts": np.bincount(sample.component, minlength=len(alpha)),
        "ess": effective_sample_size(weights),
        "largest_weight": float(weights.max()),
        "tail_index": tail_index(weights),
    }
