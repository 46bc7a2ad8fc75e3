"""Optimal weights of a mixture: the least variance there is, with a certificate."""

from __future__ import annotations

import warnings
from typing import Any, Literal, NamedTuple

import numpy as np

from evenlight.estimate import NotConvergedWarning
from evenlight.importance import regression
from evenlight.importance.active_set import minimize_on_simplex
from evenlight.importance.densities.density import Array
from evenlight.importance.mixture_objective import Face, Pilot, certificate, together

__all__ = ["OptimalMixture", "optimal_mixture"]

_COARSE_ROWS = 4096
_COARSE_STEPS = 30
_NEW_COLUMNS = 24
_ROUNDS = 100


class OptimalMixture(NamedTuple):
    """Weights, and what they are good for."""

    alpha: Array
    """Weights of the mixture, shape (J,): at least their floors, of sum 1."""
    beta: Array | None
    """Coefficients of the densities as control variates, shape (J,), or (J, k) for k integrands."""
    variance: Any
    """Of one sample of the mixture: n times the variance of the estimate, as the pilot sample sees it; of shape (k,)
    for k integrands."""
    gap: float
    """The relative duality gap: no weights have a second moment below (1 - gap) times that of these."""


def optimal_mixture(
    fp: Any,
    q: Any,
    pilot_density: Any,
    *,
    floor: Any = None,
    control_variates: bool | Literal["joint"] = True,
    gap: float = 1e-3,
) -> OptimalMixture:
    """Weights of a mixture that minimize the variance of importance sampling, from a pilot sample.

    Parameters
    ----------
    fp : array_like, shape (n,) or (n, k)
        Integrand times target density at the pilot points. For several integrands the weights minimize the sum of
        their second moments, each over its squared mean of |f|.
    q : array_like, shape (n, J)
        Densities of the components there.
    pilot_density : array_like, shape (n,)
        The density that the pilot points were drawn from. A common factor of a row of all three does not matter.
    floor : float or array_like of shape (J,), optional
        The least weight of every component; it bounds the variance by that of component j over its floor. By default
        0.1 / J.
    control_variates : bool or "joint", which takes one integrand
        True: weights that are best without control variates, then the best coefficients for them. "joint": weights and
        coefficients that are best together; better on the pilot sample, and not always on the next. False: no
        coefficients.
    gap : float
        The relative duality gap to reach.

    Returns
    -------
    OptimalMixture
        `alpha`, `beta`, `variance` and the `gap` that was reached.

    Raises
    ------
    ValueError
        If shapes do not fit, numbers are not finite, densities are negative, floors exceed 1, or f p is 0 everywhere.

    Warns
    -----
    NotConvergedWarning
        If rounding keeps the gap from being reached.

    Notes
    -----
    The problem is convex (H. Y. He and A. B. Owen, "Optimal mixture weights in multiple importance sampling",
    arXiv:1411.3954, 2014). Multiplicative steps on some of the rows find the components that matter, Newton's method on
    these alone finds their weights, and the slopes of all components say whether one is missing: few passes over q, of
    n J each, whatever the gap. Joint optimization takes n J² for each step.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import optimal_mixture
    >>> optimal_mixture([1.0], [[2.0, 3.0]], [1.0], floor=0.005, control_variates=False).alpha.round(3)
    array([0.005, 0.995])
    """
    values, pilot = _checked(fp, q, pilot_density, floor)
    if not 0 < gap < 1:
        raise ValueError(f"gap must be between 0 and 1, not {gap}")
    if control_variates not in (True, False, "joint"):
        raise ValueError(f"control_variates must be True, False or 'joint', not {control_variates!r}")
    if control_variates == "joint" and values.ndim > 1:
        raise ValueError(f"control_variates='joint' takes one integrand, not {values.shape[1]}")
    above, reached = _solve(pilot, _coarse(pilot), gap, with_beta=False)
    if control_variates == "joint":
        above, reached = _solve(pilot, above, gap, with_beta=True)
    alpha = pilot.floors + above
    alpha /= alpha.sum()
    weights = 1.0 / (pilot.density * (pilot.q @ alpha))
    mean = (values.T / pilot.density).mean(axis=-1)
    if control_variates is False:
        return OptimalMixture(alpha, None, (values.T**2 * weights).mean(axis=-1) - mean**2, reached)
    fitted = regression.fit(values, pilot.q, weights)
    second = (fitted.residuals.T**2 * weights).mean(axis=-1)
    return OptimalMixture(alpha, fitted.beta, second - (mean - fitted.beta.sum(axis=0)) ** 2, reached)


def _checked(fp: Any, q: Any, pilot_density: Any, floor: Any) -> tuple[Array, Pilot]:
    values, density = np.asarray(fp, np.float64), np.asarray(pilot_density, np.float64)
    matrix = np.asarray(q, np.float64)
    rows = values.shape[:1]
    if values.ndim not in (1, 2) or matrix.shape[:-1] != rows or density.shape != rows:
        raise ValueError(
            f"fp {values.shape}, q {matrix.shape} and pilot_density {density.shape} are not (n,), (n, J), (n,)"
        )
    n, components = matrix.shape
    if not (np.isfinite(values).all() and np.isfinite(matrix.sum()) and matrix.min() >= 0):
        raise ValueError("fp and q must be finite, and q not negative")
    if not (np.isfinite(density).all() and density.min() > 0):
        raise ValueError("pilot_density must be finite and above 0 at the points that were drawn from it")
    floors = np.broadcast_to(np.asarray(0.1 / components if floor is None else floor, np.float64), (components,)).copy()
    if not (floors.min() >= 0 and floors.sum() <= 1):
        raise ValueError(f"floors must not be negative, and add up to at most 1, not {floors.sum():.6g}")
    if not values.any():
        raise ValueError(f"f p is 0 at all {n} pilot points: nothing to learn from; take more, or better proposals")
    return values, Pilot(together(values.reshape(n, -1), density), matrix, density, floors, matrix @ floors)


def _coarse(pilot: Pilot) -> Array:
    """Rough weights above the floors, by multiplicative steps on evenly chosen rows where f p is not 0.

    a_j <- c a_j sqrt(slope_j), which never makes the second moment larger
    (S. D. Silvey, D. M. Titterington and B. Torsney, Commun. Stat. A7, 1379-1389, 1978).
    """
    rows = np.flatnonzero(pilot.fp)
    rows = rows[:: max(1, len(rows) // _COARSE_ROWS)]
    q, base = pilot.q[rows], pilot.base[rows]
    c = pilot.fp[rows] ** 2 / pilot.density[rows]
    a = np.full(q.shape[1], pilot.mass / q.shape[1])
    for _ in range(_COARSE_STEPS):
        t = base + q @ a
        a *= np.sqrt(np.divide(c, t**2, out=np.zeros_like(c), where=t > 0) @ q)
        a *= pilot.mass / a.sum()
    return a


def _solve(pilot: Pilot, above: Array, gap: float, with_beta: bool) -> tuple[Array, float]:
    """Weights above the floors, up to the gap: Newton's method on a face, and more columns until none is missing."""
    if pilot.mass <= 1e-15:
        return np.zeros_like(above), 0.0
    chosen = np.argsort(above)[::-1][: 2 * _NEW_COLUMNS]
    best, reached, tolerance = above, 1.0, min(gap / 8, 1e-4)
    for _ in range(_ROUNDS):
        face = Face(pilot, chosen, with_beta)
        start = above[chosen]
        a = minimize_on_simplex(face, start * (pilot.mass / start.sum()), tolerance)
        t = face.mixture(a)
        _, slopes, now = certificate(pilot, face.residuals(t), t)
        above = np.zeros_like(above)
        above[chosen] = a
        if now < reached:
            best, reached = above, now
        if reached <= gap:
            break
        support = chosen[a > 0]
        missing = np.argsort(slopes)[::-1][:_NEW_COLUMNS]
        if np.isin(missing[slopes[missing] > slopes[support].min()], chosen).all():
            tolerance = max(tolerance / 100, 1e-16)  # none is missing: the face's own minimum was not exact enough
        chosen = np.union1d(support, missing)
    if reached > gap:
        warnings.warn(
            f"the weights have a duality gap of {reached:.2g}, not {gap:g}", NotConvergedWarning, stacklevel=3
        )
    return best, reached
