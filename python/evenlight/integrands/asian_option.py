"""A geometric Asian call option: a payoff of many dimensions with a kink, and with an exact price."""

from __future__ import annotations

import numpy as np
from scipy import special

from .geometric_asian import geometric_asian_price
from .problem import Array, Problem

__all__ = ["AsianOption"]

_LEAST = 2.0**-65  # instead of 0, which points may have: where the quantile would be infinite
_SPOT, _STRIKE, _VOLATILITY, _RATE = 100.0, 100.0, 0.2, 0.05


class AsianOption(Problem):
    """Discounted payoff of a call on the geometric mean of d equally spaced prices within a year.

    The path is made of increments in order of time; the volatility is 20 %, the rate 5 %, spot and strike are 100.
    """

    name = "asian_option"
    kind = "kink"
    cite = "A. G. Z. Kemna and A. C. F. Vorst, J. Banking Finance 14, 113-129 (1990)"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self._steps = (np.arange(d, 0, -1) / d) * (_VOLATILITY / np.sqrt(d))  # weights of increments in the mean
        self._mean = np.log(_SPOT) + (_RATE - _VOLATILITY**2 / 2) * (d + 1) / (2 * d)
        self.exact = geometric_asian_price(d, spot=_SPOT, strike=_STRIKE, volatility=_VOLATILITY, rate=_RATE)

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        logarithm = self._mean + special.ndtri(np.maximum(x, _LEAST)) @ self._steps
        return np.asarray(np.exp(-_RATE) * np.maximum(np.exp(logarithm) - _STRIKE, 0.0))
