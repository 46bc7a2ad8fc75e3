"""Have chains mixed? Rank-normalized R-hat, effective sample sizes, Monte Carlo errors, autocorrelations, by ArviZ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .kernel import Array

__all__ = ["Diagnostics", "diagnose"]


@dataclass(frozen=True, eq=False)
class Diagnostics:
    """What draws of several chains say about themselves, for each of k quantities.

    Attributes
    ----------
    r_hat : ndarray, shape (k,)
        Rank-normalized split R-hat [1]_: near 1 if the chains agree; above 1.01 they do not yet.
    ess_bulk, ess_tail : ndarray, shape (k,)
        How many independent draws they are worth, for the center and for the 5 % and 95 % quantiles; trust errors from
        400 on. NaN unless chains and steps are independent.
    mcse_mean, mcse_sd : ndarray, shape (k,)
        Monte Carlo standard errors of mean and standard deviation; NaN as above.
    autocorrelation : ndarray, shape (n, k)
        By lag, the mean over chains.
    acceptance : ndarray, shape (chains,)
        Mean probability of acceptance.

    References
    ----------
    .. [1] A. Vehtari, A. Gelman, D. Simpson, B. Carpenter and P.-C. Bürkner, "Rank-normalization, folding, and
       localization: an improved R-hat for assessing convergence of MCMC", Bayesian Anal. 16(2), 667-718 (2021).

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, run
    >>> kernel = RandomWalk(lambda x: -0.5 * (x**2).sum(axis=1))
    >>> found = run(kernel, [0.0, 0.0], n=2000, chains=4, warm_up=200, seed=1).diagnostics()
    >>> bool((found.r_hat < 1.01).all()), bool((found.ess_bulk > 400).all())
    (True, True)
    """

    r_hat: Array
    ess_bulk: Array
    ess_tail: Array
    mcse_mean: Array
    mcse_sd: Array
    autocorrelation: Array
    acceptance: Array


def diagnose(values: Array, acceptance: Array, independent: bool) -> Diagnostics:
    """The diagnostics of values of shape (chains, n, k); `independent` says whether chains and steps are.

    Raises
    ------
    ValueError
        If there are fewer than 4 steps.
    """
    from arviz_stats.base import array_stats  # here, for it takes as long as all of NumPy

    if values.shape[1] < 4:
        raise ValueError(f"diagnostics need at least 4 steps, not {values.shape[1]}")
    axes = {"chain_axis": 0, "draw_axis": 1}

    def errors(function: Any, **settings: Any) -> Array:
        if not independent:
            return np.full(values.shape[2], np.nan)
        return np.asarray(function(values, **axes, **settings), np.float64)

    return Diagnostics(
        r_hat=np.asarray(array_stats.rhat(values, **axes, method="rank"), np.float64),
        ess_bulk=errors(array_stats.ess, method="bulk"),
        ess_tail=errors(array_stats.ess, method="tail", prob=(0.05, 0.95)),
        mcse_mean=errors(array_stats.mcse, method="mean"),
        mcse_sd=errors(array_stats.mcse, method="sd"),
        autocorrelation=np.asarray(array_stats.autocorr(values, axis=1), np.float64).mean(axis=0),
        acceptance=acceptance,
    )
