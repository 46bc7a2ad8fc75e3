"""Have chains mixed? Rank-normalized R-hat, effective sample sizes, Monte Carlo errors, autocorrelations, by ArviZ.

And what speaks against trusting them, in words.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .kernel import Array

__all__ = ["Diagnostics", "diagnose", "disagreement", "divergence", "split_r_hat"]

_LARGEST_R_HAT, _LEAST_ESS = 1.01, 400.0  # of Vehtari et al.


@dataclass(frozen=True, eq=False, repr=False)
class Diagnostics:
    """What draws of several chains say about themselves, for each of k quantities; printed, a table.

    Attributes
    ----------
    mean, sd : ndarray, shape (k,)
        Of all draws.
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
    divergences : int
        How many trajectories went wrong, where the kernel tells.

    References
    ----------
    .. [1] A. Vehtari, A. Gelman, D. Simpson, B. Carpenter and P.-C. Bürkner, "Rank-normalization, folding, and
       localization: an improved R-hat for assessing convergence of MCMC", Bayesian Anal. 16(2), 667-718 (2021).

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, run
    >>> kernel = RandomWalk(lambda x: -0.5 * (x**2).sum(axis=1))
    >>> found = run(kernel, [0.0, 0.0], n=2000, chains=4, warm_up=200, seed=1).diagnostics()
    >>> bool((found.r_hat < 1.01).all()), bool((found.ess_bulk > 400).all()), found.doubts
    (True, True, ())
    >>> found = run(kernel, [3.0, 0.0], n=100, chains=4, seed=1).diagnostics()
    >>> for doubt in found.doubts:
    ...     print(doubt)
    R-hat is 1.068 in quantity 1, above 1.01: the chains disagree, or are too short to tell
    the bulk of quantity 1 is worth 55 independent draws, fewer than 400: run longer
    the tail of quantity 1 is worth 40 independent draws, fewer than 400: run longer
    """

    mean: Array
    sd: Array
    r_hat: Array
    ess_bulk: Array
    ess_tail: Array
    mcse_mean: Array
    mcse_sd: Array
    autocorrelation: Array
    acceptance: Array
    divergences: int

    @property
    def doubts(self) -> tuple[str, ...]:
        """What speaks against trusting the draws, in words: R-hat above 1.01, an ESS below 400, divergences.

        Empty if nothing does, which proves nothing: chains that all miss the same mode agree.
        """
        found = [disagreement(self.r_hat), divergence(self.divergences)]
        for kind, ess in (("bulk", self.ess_bulk), ("tail", self.ess_tail)):
            if (ess < _LEAST_ESS).any():
                worst = int(np.nanargmin(ess))
                found.append(
                    f"the {kind} of quantity {worst} is worth {ess[worst]:.0f} independent draws, fewer than "
                    f"{_LEAST_ESS:.0f}: run longer"
                )
        return tuple(filter(None, found))

    def __repr__(self) -> str:
        """Show a table, and the doubts."""
        names = ("mean", "sd", "mcse_mean", "ess_bulk", "ess_tail", "r_hat")
        rows = [f"{'':>4}" + "".join(f"{name:>11}" for name in names)]
        columns = [getattr(self, name) for name in names]
        for k in range(len(self.mean)):
            numbers = [
                f"{column[k]:11.0f}" if "ess" in name else f"{column[k]:11.4g}"
                for name, column in zip(names, columns, strict=True)
            ]
            rows.append(f"{k:>4}" + "".join(numbers))
        return "\n".join([*rows, *self.doubts])


def disagreement(r_hat: Array) -> str:
    """A sentence if chains disagree; empty if they do not, or R-hat is not known."""
    if not (r_hat > _LARGEST_R_HAT).any():
        return ""
    worst = int(np.nanargmax(r_hat))
    return (
        f"R-hat is {r_hat[worst]:.3f} in quantity {worst}, above {_LARGEST_R_HAT}: "
        "the chains disagree, or are too short to tell"
    )


def divergence(count: int) -> str:
    """A sentence if trajectories diverged."""
    return f"{count} trajectories diverged: there are places that the chains hardly enter" if count else ""


def split_r_hat(values: Array) -> Array:
    """R-hat of halves of chains for values (chains, n, k), without ranks: for means, and in no time.

    NaN if n < 4 or all values are the same, infinite if only those of each half are.
    """
    from arviz_stats.base import array_stats

    if values.shape[1] < 4:
        return np.full(values.shape[2], np.nan)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(array_stats.rhat(values, chain_axis=0, draw_axis=1, method="split"), np.float64)


def diagnose(values: Array, acceptance: Array, independent: bool, divergences: int = 0) -> Diagnostics:
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
        mean=values.mean(axis=(0, 1)),
        sd=values.std(axis=(0, 1), ddof=1),
        r_hat=np.asarray(array_stats.rhat(values, **axes, method="rank"), np.float64),
        ess_bulk=errors(array_stats.ess, method="bulk"),
        ess_tail=errors(array_stats.ess, method="tail", prob=(0.05, 0.95)),
        mcse_mean=errors(array_stats.mcse, method="mean"),
        mcse_sd=errors(array_stats.mcse, method="sd"),
        autocorrelation=np.asarray(array_stats.autocorr(values, axis=1), np.float64).mean(axis=0),
        acceptance=acceptance,
        divergences=divergences,
    )
