"""The exact price of a call on the geometric mean of prices, for Asian options as integrals and as chains."""

from __future__ import annotations

import math

import numpy as np
from scipy import special

__all__ = ["geometric_asian_price"]


def geometric_asian_price(steps: int, *, spot: float, strike: float, volatility: float, rate: float) -> float:
    """The discounted price of a call on the geometric mean of `steps` equally spaced prices within a year.

    Parameters
    ----------
    steps : int
        How many prices, at least 1.
    spot, strike, volatility : float
        Of the Black-Scholes model, above 0.
    rate : float
        Of interest, per year.

    Returns
    -------
    float

    Notes
    -----
    The mean is log-normal: A. G. Z. Kemna and A. C. F. Vorst, J. Banking Finance 14, 113-129 (1990). Cost O(steps).

    Examples
    --------
    One price is that of the end, and the option a European one.

    >>> from evenlight.integrands.geometric_asian import geometric_asian_price
    >>> print(f"{geometric_asian_price(1, spot=100, strike=100, volatility=0.2, rate=0.05):.6f}")
    10.450584
    """
    mean = math.log(spot) + (rate - volatility**2 / 2) * (steps + 1) / (2 * steps)
    spread = volatility / math.sqrt(steps) * float(np.linalg.norm(np.arange(1, steps + 1) / steps))
    edge = (mean - math.log(strike)) / spread
    value = math.exp(mean + spread**2 / 2) * special.ndtr(edge + spread) - strike * special.ndtr(edge)
    return float(math.exp(-rate) * value)
