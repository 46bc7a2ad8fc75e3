"""Ratios of two integrals over the same points."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from evenlight.estimate import Estimate, from_error
from evenlight.integrate import integrate

__all__ = ["ratio"]


def ratio(
    f: Callable[[Any], Any], g: Callable[[Any], Any], points: Any, *, n: int, replicates: int = 16, domain: Any = None
) -> Estimate:
    """Estimate the integral of f over that of g.

    The same points for both cancel much of the error where f and g are alike. The bias, of order 1 / replicates of the
    variance, is taken out by the jackknife over replicates, which gives the error as well.

    Parameters
    ----------
    f, g : callable
        From points, shape (m, d), to values, shape (m,); the integral of g is not 0.
    points : evenlight.points.Engine
        With randomness to replicate; independent points are as good as any.
    n : int
        Points in all, a multiple of `replicates`; each takes a value of f and one of g.
    replicates : int
        Independent randomizations.
    domain : domain, optional
        As for `integrate`.

    Returns
    -------
    Estimate
        Of the ratio.

    Raises
    ------
    ValueError
        If the mean of g is 0.

    Notes
    -----
    M. H. Quenouille, Biometrika 43, 353-360 (1956).

    Examples
    --------
    >>> from evenlight.points import Sobol
    >>> from evenlight.reduction import ratio
    >>> estimate = ratio(lambda x: x[:, 0] ** 2, lambda x: x[:, 0], Sobol(1), n=4096)
    >>> bool(abs(estimate.value - 2 / 3) < 1e-4)
    True
    """
    both = integrate(
        lambda x: np.stack([np.asarray(f(x)), np.asarray(g(x))], axis=1),
        points,
        n=n,
        replicates=replicates,
        method="rqmc",
        domain=domain,
    )
    means = both.diagnostics["replicates"]
    if not both.value[1]:
        raise ValueError("the mean of g is 0: there is no ratio")
    whole = both.value[0] / both.value[1]
    rest = means.sum(axis=0) - means
    left_out = replicates * whole - (replicates - 1) * rest[:, 0] / rest[:, 1]
    error = float(left_out.std(ddof=1) / np.sqrt(replicates))
    estimate = Estimate(
        value=float(left_out.mean()),
        standard_error=error,
        n=both.n,
        replicates=replicates,
        cost=2 * both.cost,
        method="ratio",
        message=both.message,
        diagnostics={"points": both.diagnostics["points"]},
        degrees_of_freedom=replicates - 1.0,
    )
    return from_error(estimate)
