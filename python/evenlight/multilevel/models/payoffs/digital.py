"""Digital call: the strike's amount if the price at the end is above the strike. A jump, the hardest of the five."""

from __future__ import annotations

import math

import numpy as np
from scipy import special

from evenlight.multilevel.models.option import normal_cdf
from evenlight.multilevel.models.path import Path

from .payoff import Array, Payoff

__all__ = ["Digital"]


class Digital(Payoff):
    """Discounted K 1{S_T > K}. Variance exponents: 1/2 with Euler's scheme; 3/2 with Milstein's, smooth."""

    name = "digital"
    cite = "M. B. Giles, in Monte Carlo and Quasi-Monte Carlo Methods 2006, 343-358 (2008)"

    def plain(self, path: Path) -> Array:
        """All or nothing."""
        return np.asarray((path.values[-1] > self.option.strike) * (self.option.strike * self.option.discount))

    def smooth(self, path: Path) -> Array:
        """The probability to end above, given the motion up to the last increment, by Euler's scheme from there."""
        last = path.values[-2]
        known = path.increments[len(path.increments) - path.ratio : -1].sum(
            axis=0
        )  # of the last step, all but the last
        ahead = last * (1.0 + self.option.rate * path.step + path.volatility * known)
        ahead -= self.option.strike
        ahead /= last
        ahead /= path.volatility * math.sqrt(path.step / path.ratio)
        return np.asarray(special.ndtr(ahead) * (self.option.strike * self.option.discount))

    def exact(self) -> float:
        """The strike's amount times the risk-neutral probability."""
        option = self.option
        spread = option.volatility * math.sqrt(option.horizon)
        edge = (math.log(option.spot / option.strike) + option.rate * option.horizon) / spread
        return option.strike * option.discount * normal_cdf(edge - spread / 2)
