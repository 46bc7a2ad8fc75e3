"""Ratios of two integrals over the same points."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from evenlight.estimate import Estimate, from_error, plain
from evenlight.integration import integrate

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
        From points, shape (m, d), to values, shape (m,), or for f shape (m, ...); the integral of g is not 0.
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
        If the mean of g is 0, or g has several values.

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
    settings: dict[str, Any] = {"n": n, "replicates": replicates, "method": "rqmc", "domain": domain}
    above, below = integrate(f, points, **settings), integrate(g, points, **settings)
    if np.ndim(below.value) or not below.value:
        raise ValueError(f"g must be one number of mean other than 0, not of mean {below.value}: there is no ratio")
    rest = [means.sum(axis=0) - means for means in (above.diagnostics["replicates"], below.diagnostics["replicates"])]
    left_out = replicates * above.value / below.value - (replicates - 1) * (rest[0].T / rest[1]).T
    estimate = Estimate(
        value=plain(left_out.mean(axis=0)),
        standard_error=plain(left_out.std(axis=0, ddof=1) / np.sqrt(replicates)),
        n=above.n,
        replicates=replicates,
        cost=above.cost + below.cost,
        method="ratio",
        message=above.message,
        diagnostics={"points": above.diagnostics["points"]},
        degrees_of_freedom=replicates - 1.0,
    )
    return from_error(estimate)
