"""An option on an asset that follows geometric Brownian motion: plain numbers, and Black and Scholes's price."""

from __future__ import annotations

import math
from dataclasses import dataclass

from scipy import special

__all__ = ["Option", "black_scholes_call", "normal_cdf"]


@dataclass(frozen=True)
class Option:
    """Terms of an option and of its asset, in one currency and in years.

    Examples
    --------
    >>> from evenlight.multilevel.models import Option
    >>> round(Option(volatility=0.3).discount, 6)
    0.951229
    """

    spot: float = 100.0
    """The asset's price now, above 0."""
    strike: float = 100.0
    """The price in the contract, above 0."""
    rate: float = 0.05
    """The interest rate, continuously compounded, per year."""
    volatility: float = 0.2
    """Standard deviation of the logarithm of the price per root of a year, above 0."""
    horizon: float = 1.0
    """Years until it is settled, above 0."""
    barrier: float = 85.0
    """What ends a barrier option: above 0 and at most the spot and the strike. Other options do not look at it."""

    def __post_init__(self) -> None:
        for name in ("spot", "strike", "volatility", "horizon", "barrier"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be above 0 and finite, not {getattr(self, name)}")
        if not math.isfinite(self.rate):
            raise ValueError(f"rate must be finite, not {self.rate}")

    @property
    def discount(self) -> float:
        """What one unit at the end is worth now."""
        return math.exp(-self.rate * self.horizon)


def normal_cdf(x: float) -> float:
    """The distribution function of the standard normal distribution."""
    return float(special.ndtr(x))


def black_scholes_call(option: Option, spot: float | None = None) -> float:
    """The price of a European call by F. Black and M. Scholes, J. Political Econ. 81(3), 637-654 (1973).

    `spot` replaces the option's own, as the reflections of barrier options need it.

    Examples
    --------
    >>> from evenlight.multilevel.models import Option, black_scholes_call
    >>> round(black_scholes_call(Option()), 10)
    10.4505835722
    """
    price = option.spot if spot is None else spot
    spread = option.volatility * math.sqrt(option.horizon)
    edge = (math.log(price / option.strike) + option.rate * option.horizon) / spread
    return price * normal_cdf(edge + spread / 2) - option.strike * option.discount * normal_cdf(edge - spread / 2)
