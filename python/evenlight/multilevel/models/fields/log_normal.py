"""Log-normal coefficients with exponential covariance, by their Karhunen-Loève expansion: the model of porous rock."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from scipy import optimize

from evenlight.arguments import integer
from evenlight.multilevel.brownian import normals

from .field import Array

__all__ = ["LogNormalField"]


class LogNormalField:
    """exp(Z), Z Gaussian of mean 0 and covariance σ² exp(-|x - y|₁ / ℓ) on the unit interval or square.

    Parameters
    ----------
    terms : int
        Of the Karhunen-Loève expansion, those of largest variance.
    sigma : float
        The standard deviation of Z (that of the expansion without end).
    length : float
        The correlation length ℓ.

    Raises
    ------
    ValueError
        If a number is not positive.

    Notes
    -----
    Cost: `terms` operations and an exponential per place. In one dimension the eigenfunctions are sines and cosines
    whose frequencies solve a transcendental equation; in two, products of them.

    Reference: R. G. Ghanem and P. D. Spanos, *Stochastic Finite Elements* (1991), section 2.3.3.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import LogNormalField
    >>> LogNormalField(terms=3).values(np.full((1, 3), 0.5), np.array([0.2, 0.8])).round(6)
    array([[1., 1.]])
    """

    def __init__(self, terms: int = 8, *, sigma: float = 1.0, length: float = 0.3) -> None:
        if not (0.0 < sigma < math.inf and 0.0 < length < math.inf):
            raise ValueError(f"sigma and length must be above 0, not {sigma} and {length}")
        self.terms = integer("terms", terms, 1)
        self.sigma, self.length = float(sigma), float(length)
        self._frequencies = _frequencies(self.terms, self.length)
        self._variances = 2.0 * self.length / (1.0 + (self.length * self._frequencies) ** 2)
        products = np.outer(self._variances, self._variances)
        order = np.argsort(-products, axis=None, kind="stable")[: self.terms]
        self._pairs = np.unravel_index(order, products.shape)

    def values(self, u: Array, *places: Array) -> Array:
        """See `Field`."""
        if len(places) == 1:
            modes = self._modes(places[0])
        else:
            first, second = (self._modes(place)[which] for place, which in zip(places, self._pairs, strict=True))
            modes = first * second
        gaussian = normals(u) @ (self.sigma * modes[: u.shape[1]])
        return np.asarray(np.exp(gaussian, out=gaussian))

    def _modes(self, x: Array) -> Array:
        """Orthonormal eigenfunctions times the roots of their eigenvalues, shape (terms, m)."""
        w = self._frequencies[:, np.newaxis]
        # ∫ (ℓ w cos wx + sin wx)² over [0, 1], with the equation of w put in
        norm = np.sqrt(0.5 * (1.0 + (self.length * w) ** 2) + self.length)
        shapes = (self.length * w * np.cos(w * x) + np.sin(w * x)) / norm
        return np.asarray(shapes * np.sqrt(self._variances)[:, np.newaxis])


def _frequencies(terms: int, length: float) -> Array:
    """The positive solutions of (ℓ² w² - 1) sin w = 2 ℓ w cos w, one between (k - 1) π and k π."""

    def equation(w: float) -> float:
        return (length**2 * w**2 - 1.0) * math.sin(w) - 2.0 * length * w * math.cos(w)

    edges = np.pi * np.arange(terms + 1) + 1e-12
    return np.array([optimize.brentq(equation, low, high, xtol=1e-14) for low, high in pairwise(edges)])
