"""Second moments of mixture estimates as functions of the mixture's weights, from a pilot sample."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import linalg

from evenlight.importance.densities.density import Array

__all__ = ["Face", "Pilot", "certificate", "together"]

_CUTOFF = 1e-13  # of eigenvalues of normal equations


def together(fp: Array, density: Array) -> Array:
    """One function for several, whose second moment is the sum of theirs, each over its squared mean size.

    Parameters
    ----------
    fp : ndarray of float64, shape (n, k)
        Integrands times target density, not all 0.
    density : ndarray of float64, shape (n,)
        The density that the points were drawn from.

    Returns
    -------
    ndarray of float64, shape (n,)
        For k = 1, f p itself.
    """
    if fp.shape[1] == 1:
        return fp[:, 0]
    sizes = np.mean(np.abs(fp) / density[:, np.newaxis], axis=0)
    return np.asarray(np.sqrt(((fp[:, sizes > 0] / sizes[sizes > 0]) ** 2).sum(axis=1)))


class Pilot(NamedTuple):
    """A pilot sample: f p, the densities, the density it was drawn from, and what the floors alone make of it."""

    fp: Array
    q: Array
    density: Array
    floors: Array
    base: Array

    @property
    def mass(self) -> float:
        """What the weights have to share above their floors."""
        return 1.0 - float(self.floors.sum())


class Face:
    """The second moment on the face of the simplex where a few components are above their floors.

    V(a) = mean of (fp - beta q)^2 / (pilot density * (base + sum of a_j q_j)), where beta is 0 or minimizes V.

    Parameters
    ----------
    pilot : Pilot
        The sample.
    chosen : ndarray of int, shape (s,)
        The components of the face.
    with_beta : bool
        Whether beta is to be optimal; it is then eliminated, which leaves a convex function of a.
    """

    def __init__(self, pilot: Pilot, chosen: NDArray[np.intp], with_beta: bool) -> None:
        self._pilot = pilot
        self._z = pilot.q.T[chosen]
        self._with_beta = with_beta

    def mixture(self, a: Array) -> Array:
        """The mixture's density at the pilot points."""
        return np.asarray(self._pilot.base + a @ self._z)

    def residuals(self, t: Array) -> Array:
        """What beta leaves of f p where the mixture's density is t."""
        return self._solve(t)[0] if self._with_beta else self._pilot.fp

    def value(self, a: Array) -> float:
        """The second moment."""
        t = self.mixture(a)
        return float(np.mean(self.residuals(t) ** 2 / (self._pilot.density * t)))

    def derivatives(self, a: Array) -> tuple[float, Array, Array]:
        """The second moment, its gradient and its Hessian."""
        t = self.mixture(a)
        n = len(t)
        residuals, vectors, values = self._solve(t) if self._with_beta else (self._pilot.fp, None, None)
        terms = residuals**2 / (self._pilot.density * t)
        terms_over_t = terms / t
        gradient = -(self._z @ terms_over_t) / n
        hessian = 2 * (self._z * (terms_over_t / t)) @ self._z.T / n
        if vectors is not None and values is not None:
            mixed = (self._pilot.q.T * (residuals / (self._pilot.density * t**2))) @ self._z.T
            reduced = vectors.T @ mixed
            hessian = hessian - 2 * reduced.T @ (reduced / values[:, np.newaxis]) / n
        return float(terms.mean()), gradient, hessian

    def _solve(self, t: Array) -> tuple[Array, Array, Array]:
        """Residuals of weighted least squares, and the eigenvectors and eigenvalues of its normal equations."""
        q, weights = self._pilot.q, 1.0 / (self._pilot.density * t)
        values, vectors = linalg.eigh((q.T * weights) @ q)
        kept = values > _CUTOFF * values[-1]
        values, vectors = values[kept], vectors[:, kept]
        beta = vectors @ ((vectors.T @ (q.T @ (weights * self._pilot.fp))) / values)
        return self._pilot.fp - q @ beta, vectors, values


def certificate(pilot: Pilot, residuals: Array, t: Array) -> tuple[float, Array, float]:
    """The second moment, minus its slopes in alpha, and the relative duality gap.

    The second moment is convex and homogeneous of degree -1 in alpha (with beta optimal, too), so that its
    tangent gives V* >= V^2 / m with m = sum of floors_j g_j + (1 - sum of floors) max g_j, and g the slopes.
    """
    terms = residuals**2 / (pilot.density * t)
    slopes = (terms / t) @ pilot.q / len(t)
    value = float(terms.mean())
    most = float(pilot.floors @ slopes) + pilot.mass * float(slopes.max())
    return value, slopes, max(0.0, 1.0 - value / most) if most > 0 else 0.0
