"""Lookback call: the price at the end less the lowest price on the way."""

from __future__ import annotations

import math

import numpy as np

from evenlight.multilevel.models.option import normal_cdf
from evenlight.multilevel.models.path import Path

from .payoff import Array, Payoff

__all__ = ["Lookback"]

_BETWEEN = (
    0.5825971579390106  # -ζ(1/2)/√(2π): what a discretely observed minimum misses, in standard deviations of a step
)


class Lookback(Payoff):
    """Discounted S_T - min S. Variance exponents: 1 with Euler's scheme, 2 with Milstein's and the bridge's minimum."""

    name = "lookback"
    cite = "M. B. Giles, in Monte Carlo and Quasi-Monte Carlo Methods 2006, 343-358 (2008)"
    takes_uniforms = True

    def plain(self, path: Path) -> Array:
        """From the lowest value, corrected for what lies between (Broadie, Glasserman and Kou 1997, first order)."""
        correction = 1.0 - _BETWEEN * self.option.volatility * math.sqrt(path.step)
        return np.asarray((path.values[-1] - path.values.min(axis=0) * correction) * self.option.discount)

    def smooth(self, path: Path) -> Array:
        """Each step's minimum drawn from the law of a bridge's: (a + b - √((a - b)² - 2 β² h log U)) / 2."""
        assert path.uniforms is not None
        bridge = path.refined()
        start, stop = bridge.values[:-1], bridge.values[1:]
        # 1 - U is never 0
        lowest = np.log1p(-path.uniforms)
        lowest *= -2.0 * bridge.step
        lowest *= bridge.diffusion
        lowest *= bridge.diffusion
        gap = start - stop
        gap *= gap
        lowest += gap
        np.sqrt(lowest, out=lowest)
        np.subtract(start + stop, lowest, out=lowest)
        return np.asarray((bridge.values[-1] - 0.5 * lowest.min(axis=0)) * self.option.discount)

    def exact(self) -> float:
        """By M. B. Goldman, H. B. Sosin and M. A. Gatto, J. Finance 34(5), 1111-1127 (1979), for rates above 0."""
        option = self.option
        if option.rate <= 0.0:
            raise ValueError(f"the price of a lookback option needs a rate above 0, not {option.rate}")
        spread = option.volatility * math.sqrt(option.horizon)
        drift = option.rate * option.horizon / spread
        share = option.volatility**2 / (2.0 * option.rate)
        above, below, other = drift + spread / 2, drift - spread / 2, spread / 2 - drift
        rising = normal_cdf(above) - share * normal_cdf(-above)
        falling = option.discount * (normal_cdf(below) - share * normal_cdf(-other))
        return option.spot * (rising - falling)
