"""How fast errors fall: root mean squared errors against n, and the slope with its own error."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenlight.integrand import Integrand
from evenlight.replicate_means import ReplicateMeans

__all__ = ["Rates", "rates"]

Array = NDArray[np.float64]


class Rates(NamedTuple):
    """Errors at doubling numbers of points, and the power of n that they follow."""

    n: Array
    """Numbers of points of one replicate."""
    rmse: Array
    """Root mean squared error at each."""
    slope: float
    """Of log rmse in log n, after taking out (log n)^log_power."""
    slope_error: float
    """Its standard error, by the jackknife over replicates; NaN for fixed points."""


def rates(
    f: Callable[[Any], Any],
    points: Any,
    *,
    exact: float | None = None,
    least: int = 2**5,
    most: int = 2**12,
    replicates: int = 100,
    log_power: float = 0.0,
) -> Rates:
    """Measure how fast the error of the mean of f over points falls.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,).
    points : evenlight.points.Engine
        Fixed, or with randomness to replicate; of designs, which have all their points at once, one for every number.
    exact : float, optional
        The integral; by default `f.exact`, which test integrands have.
    least, most : int
        The numbers of points are the doublings of the first up to the second.
    replicates : int
        Independent randomizations.
    log_power : float
        The errors are divided by this power of log n before the fit: (d - 1) / 2 for scrambled nets.

    Returns
    -------
    Rates
        Errors and slope.

    Raises
    ------
    ValueError
        If there is no exact integral, fewer than two numbers of points, several values for a point, or an error of 0.

    Examples
    --------
    >>> from evenlight import integrands, lab
    >>> from evenlight.points import Sobol
    >>> measured = lab.rates(integrands.build("additive_exponential", 1), Sobol(1, seed=1))
    >>> abs(measured.slope + 1.5) < 0.1
    True
    """
    truth = getattr(f, "exact", None) if exact is None else exact
    if truth is None:
        raise ValueError("the exact integral must be known: give exact=")
    if not 2 <= least < 2 * least <= most:
        raise ValueError(f"from least = {least} to most = {most} there must be a doubling")
    counts = least * 2 ** np.arange(int(np.log2(most / least)) + 1)
    squares = np.array([(means - truth) ** 2 for means in _means(f, points, counts, replicates)])
    errors = np.sqrt(squares.mean(axis=1))
    if not errors.all():
        raise ValueError(f"the error is 0 at n = {counts[errors.argmin()]}: there is no slope")
    slope = _slope(counts, errors, log_power)
    if squares.shape[1] == 1:
        return Rates(counts.astype(np.float64), errors, float(slope), float("nan"))
    without = np.sqrt((squares.sum(axis=1, keepdims=True) - squares) / (squares.shape[1] - 1))
    slopes = _slope(counts, without, log_power)
    jackknife = np.sqrt((len(slopes) - 1) * np.mean((slopes - slopes.mean()) ** 2))
    return Rates(counts.astype(np.float64), errors, float(slope), float(jackknife))


def _means(f: Callable[[Any], Any], points: Any, counts: Any, replicates: int) -> list[Array]:
    """Means of every replicate at every number of points, each value computed once."""
    integrand = Integrand(f, None, "raise")
    if not points.is_random:
        values, _ = integrand(points.points(0, int(counts[-1])), 0)
        sums = np.cumsum(_numbers(values))
        return [sums[[n - 1]] / n for n in counts]
    state = ReplicateMeans(integrand, points, replicates)
    found = []
    for n in counts:
        if getattr(points, "finite", False):
            state = ReplicateMeans(integrand, points, replicates)
        state.extend(int(n))
        found.append(_numbers(state.means.copy()))
    return found


def _numbers(values: Array) -> Array:
    if values.ndim != 1:
        raise ValueError(f"f must return one number for each point, not {values.shape[1:]}")
    return values


def _slope(n: Any, errors: Array, log_power: float) -> Any:
    """The least-squares slope of log error, less log_power log log n, in log n; for each column of errors."""
    x = np.log(n)
    y = np.log(errors) - (log_power * np.log(x)).reshape(-1, *[1] * (errors.ndim - 1))
    weights = (x - x.mean()) / ((x - x.mean()) ** 2).sum()
    return weights @ y
