"""Control variates: functions of known integral take out what they explain of an integrand."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.estimate import Estimate, from_moments, plain
from evenlight.importance.regression import fit
from evenlight.integrand import Integrand
from evenlight.moments import Moments

__all__ = ["control_variates"]

Array = NDArray[np.float64]


def control_variates(
    f: Callable[[Any], Any],
    controls: Callable[[Any], Any],
    means: Any,
    points: Any,
    *,
    n: int,
    replicates: int = 16,
    domain: Any = None,
) -> Estimate:
    """Integrate f with the help of functions whose integrals are known.

    Coefficients are those of least squares over all points, safe where controls depend on each other. For evenly spread
    points controls help with what the points themselves are bad at.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...), each with coefficients of its own.
    controls : callable
        From points, shape (m, d), to values, shape (m, k).
    means : array_like, shape (k,)
        Integrals of the controls.
    points : evenlight.points.Engine
        With randomness to replicate.
    n : int
        Function values of f, a multiple of `replicates`.
    replicates : int
        Independent randomizations, at least 2, whose spread is the error.
    domain : domain, optional
        As for `integrate`.

    Returns
    -------
    Estimate
        With the coefficients `beta`, shape (k, ...), and `explained`, the share of the variance that is gone, among
        the diagnostics.

    Raises
    ------
    ValueError
        If shapes do not fit, or n is no multiple of the replicates.

    Notes
    -----
    A. B. Owen, *Monte Carlo theory, methods and examples*, chapter 8; for evenly spread points F. J. Hickernell,
    C. Lemieux and A. B. Owen, Stat. Sci. 20(1), 1-31 (2005).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.points import Independent
    >>> from evenlight.reduction import control_variates
    >>> f = lambda x: np.exp(x[:, 0])
    >>> powers = lambda x: np.stack([x[:, 0], x[:, 0] ** 2], axis=1)
    >>> estimate = control_variates(f, powers, [1 / 2, 1 / 3], Independent(1), n=16 * 256)
    >>> bool(abs(estimate.value - (np.e - 1)) < 1e-3), estimate.diagnostics["explained"] > 0.999
    (True, True)
    """
    if n % replicates or n < 2 * replicates:
        raise ValueError(f"n = {n} is no multiple of {replicates} replicates")
    rows = n // replicates
    u = points.points(0, rows, replicates=replicates).reshape(n, -1)
    y, _ = Integrand(f, domain, "raise")(u, 0, replicates)
    h, _ = Integrand(controls, domain, "raise")(u, 0, replicates)
    wanted = np.asarray(means, np.float64)
    if h.ndim != 2 or wanted.shape != h.shape[1:]:
        raise ValueError(f"controls {h.shape} and means {wanted.shape} are not (n, k) and (k,)")
    fitted = fit(y.reshape(n, -1), np.column_stack([np.ones(n), h - wanted]))
    values = (fitted.residuals + fitted.beta[0]).reshape(replicates, rows, *y.shape[1:])
    total, left = np.var(y, axis=0), np.mean(fitted.residuals**2, axis=0).reshape(y.shape[1:])
    return from_moments(
        ((rows, Moments.of(values.mean(axis=1))),),
        method="control variates",
        cost=float(n),
        message="as many function values as asked",
        diagnostics={
            "points": (repr(points),),
            "beta": fitted.beta[1:].reshape(-1, *y.shape[1:]),
            "explained": plain(1.0 - left / np.where(total > 0, total, np.inf)),
        },
    )
