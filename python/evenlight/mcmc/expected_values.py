"""Integrals over the unit cube from every step of Metropolis chains, proposals that were rejected among them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import logsumexp

from evenlight.arguments import check_callable
from evenlight.estimate import Estimate, from_moments
from evenlight.moments import Moments

from .chains import Chains, values_at
from .kernel import Array
from .target import check_positive

__all__ = ["expected_value_integral"]


def expected_value_integral(chains: Chains, function: Callable[[Any], Any], *, total: float | None = None) -> Estimate:
    """The integral of a function over the unit cube, from accepted and rejected proposals of a run.

    Each step counts twice: its proposal y with the probability a of acceptance, where the chain was, x, with 1 - a.
    Large steps are uniform points besides, and all are weighted as in multiple importance sampling [1]_: with the
    target C, its integral b and the probability p of large steps, a step contributes ``(a + [large]) f(y) / (C(y) / b +
    p) + (1 - a) f(x) / (C(x) / b + p)``. What the chains rarely visit thus comes from their large steps.

    Parameters
    ----------
    chains : Chains
        A run of `PrimarySampleSpace` with a burn-in, or that starts in equilibrium.
    function : callable
        From points (m, d) of the cube to values (m,) or (m, k): for an image, C at the pixels.
    total : float, optional
        b, if it is known; by default each chain estimates its own, by the mean of the target over its large steps.

    Returns
    -------
    Estimate
        With a standard error from the chains. Unbiased in equilibrium if `total` is right; otherwise with a bias of
        order 1 / n.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above, draws were not kept, a value is not finite, or a chain has not found the target
        by a large step.

    Notes
    -----
    Cost: the function at 2 n points for each chain; memory: their values. The gain over counting draws is in what the
    target makes rare. Where it is large, and `total` is left out, the error of b may outweigh it: in a test of ten bins
    the variance of eight dark ones was 2.4 to 3.8 times smaller, that of two bright ones 1.3 to 1.5 times larger.

    References
    ----------
    .. [1] C. Kelemen, L. Szirmay-Kalos, G. Antal and F. Csonka, "A simple and robust mutation strategy for the
       Metropolis light transport algorithm", Comput. Graph. Forum 21(3), 531-540 (2002).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import PrimarySampleSpace, expected_value_integral, run
    >>> kernel = PrimarySampleSpace(lambda u: -20 * abs(u[:, 0] - 0.3))
    >>> chains = run(kernel, [0.3], n=2000, chains=16, burn_in=100, seed=1)
    >>> estimate = expected_value_integral(chains, lambda u: np.exp(-20 * abs(u[:, 0] - 0.3)))
    >>> exact = (2 - np.exp(-6) - np.exp(-14)) / 20
    >>> abs(estimate.value - exact) < 4 * estimate.standard_error < 0.01
    True
    """
    check_callable("function", function)
    log_densities, counts, points = _weighed_points(chains)
    share = float(chains.kernel.large_step)
    if total is None:
        log_b = _log_totals(chains)
    else:
        check_positive("total", total)
        log_b = np.full(len(counts[0]), np.log(total))
    steps = counts[0].shape[1]
    means = np.zeros(())
    for log_density, count, at in zip(log_densities, counts, points, strict=True):
        weights = count / (np.exp(log_density - log_b[:, None]) + share) / steps
        means = means + np.einsum("cn,cn...->c...", weights, values_at(function, at))
    return from_moments(
        ((float(steps), Moments.of(means)),),
        method=f"expected values of {chains.kernel.name} driven by {chains.points.name}",
        cost=float(len(means) * (chains.n + sum(chains.steps_before))),
        diagnostics={"replicates": means, "points": (f"chains of seed {chains.seed}",)},
    )


def _weighed_points(chains: Chains) -> tuple[list[Array], list[Array], list[Array]]:
    """Log densities, counts and places of all proposals, and of where the chains were; from the second step on."""
    if chains.kernel.name != "primary_sample_space":
        raise ValueError(f"the chains must be of the kernel primary_sample_space, not {chains.kernel.name}")
    if chains.points.coupled > 1:
        raise ValueError(f"{chains.points.name} couples chains: their spread is no error")
    if chains.n < 2:
        raise ValueError("expected values need at least 2 steps, not 1")
    info, draws = chains.info, chains.kept_draws()
    acceptance, large = info["acceptance"][:, 1:], info["large"][:, 1:]
    log_densities = [info["proposal_log_density"][:, 1:], info["log_density"][:, :-1]]
    found = (large & np.isfinite(log_densities[0])).any(axis=1)
    if not found.all():
        chain = int(np.argmin(found))
        raise ValueError(f"no large step of chain {chain} has found the target: take more steps, or more large ones")
    return log_densities, [acceptance + large, 1 - acceptance], [info["proposal"][:, 1:], draws[:, :-1]]


def _log_totals(chains: Chains) -> Array:
    """For each chain the logarithm of the mean of the target over its large steps."""
    large = chains.info["large"]
    log_density = np.where(large, chains.info["proposal_log_density"], -np.inf)
    return np.asarray(logsumexp(log_density, axis=1) - np.log(large.sum(axis=1)))
