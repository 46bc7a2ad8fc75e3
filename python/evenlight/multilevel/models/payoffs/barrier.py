"""Down-and-out call: a European call that is void once the price has been at the barrier."""

from __future__ import annotations

import numpy as np

from evenlight.multilevel.models.option import Option, black_scholes_call
from evenlight.multilevel.models.path import Path

from .payoff import Array, Payoff

__all__ = ["Barrier"]


class Barrier(Payoff):
    """Discounted (S_T - K)^+ if min S > B. Variance exponents: 1/2 with Euler's scheme; 3/2 with Milstein's, smooth."""

    name = "barrier"
    cite = "M. B. Giles, in Monte Carlo and Quasi-Monte Carlo Methods 2006, 343-358 (2008)"

    def __init__(self, option: Option) -> None:
        super().__init__(option)
        if not option.barrier <= min(option.spot, option.strike):
            raise ValueError(f"barrier must be at most spot and strike, not {option.barrier}")

    def plain(self, path: Path) -> Array:
        """Void if a grid point is at the barrier."""
        alive = path.values.min(axis=0) > self.option.barrier
        return np.asarray(np.maximum(path.values[-1] - self.option.strike, 0.0) * alive * self.option.discount)

    def smooth(self, path: Path) -> Array:
        """Times the probability that no step's bridge is at the barrier: 1 - exp(-2 (a - B)^+ (b - B)^+ / (β² h))."""
        bridge = path.refined()
        above = bridge.values - self.option.barrier
        np.maximum(above, 0.0, out=above)
        hit = above[:-1] * above[1:]
        hit /= bridge.diffusion
        hit /= bridge.diffusion
        hit *= -2.0 / bridge.step
        survival = np.multiply.reduce(-np.expm1(hit, out=hit), axis=0)
        return np.asarray(np.maximum(bridge.values[-1] - self.option.strike, 0.0) * survival * self.option.discount)

    def exact(self) -> float:
        """By reflection: R. C. Merton, Bell J. Econ. Manag. Sci. 4(1), 141-183 (1973)."""
        option = self.option
        power = 2.0 * option.rate / option.volatility**2 - 1.0
        image = black_scholes_call(option, option.barrier**2 / option.spot)
        return float(black_scholes_call(option) - (option.barrier / option.spot) ** power * image)
