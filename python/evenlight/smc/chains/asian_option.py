"""An Asian option priced step by step: two coordinates, the price and the mean so far. The usual test of Array-RQMC."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from evenlight.integrands.geometric_asian import geometric_asian_price
from evenlight.smc.state_space import normals

from .chain import Array, MarkovChain

__all__ = ["AsianOptionChain"]


class AsianOptionChain(MarkovChain):
    """The discounted payoff of a call on the mean of `steps` equally spaced prices within a year.

    Parameters
    ----------
    steps : int
        How many prices.
    geometric : bool
        The geometric mean, whose price is known (`exact`; NaN for the arithmetic mean).
    spot, strike, volatility, rate : float
        Of the Black-Scholes model.

    Raises
    ------
    ValueError
        If there is no step, or spot, strike or volatility is not above 0.

    Examples
    --------
    >>> from evenlight import smc
    >>> chain = smc.AsianOptionChain(10, geometric=True)
    >>> estimate = smc.array_rqmc(chain, chains=4096, seed=1)
    >>> abs(estimate.value - chain.exact) < 4 * estimate.standard_error < 0.01
    True
    """

    name = "asian_option"
    dims, step_uniforms = 2, 1

    def __init__(
        self,
        steps: int = 10,
        geometric: bool = False,
        *,
        spot: float = 100.0,
        strike: float = 100.0,
        volatility: float = 0.2,
        rate: float = 0.05,
    ) -> None:
        if steps < 1 or not (spot > 0 and strike > 0 and volatility > 0):
            raise ValueError(
                f"steps must be at least 1, and spot, strike and volatility above 0; not {steps}, {spot}, {strike}, "
                f"{volatility}"
            )
        self.steps, self.geometric, self.strike, self._discount = steps, geometric, strike, math.exp(-rate)
        self._log_spot, self._drift = math.log(spot), (rate - volatility**2 / 2) / steps
        self._spread = volatility / math.sqrt(steps)
        model = {"spot": spot, "strike": strike, "volatility": volatility, "rate": rate}
        self.exact = geometric_asian_price(steps, **model) if geometric else math.nan

    def init(self, n: int) -> Array:
        """The logarithm of the spot, and a mean of nothing."""
        return np.tile([self._log_spot, 0.0], (n, 1))

    def step(self, t: int, states: Array, u: Array) -> Array:
        """One normal number moves the price; it enters the running mean."""
        logarithm = states[:, 0] + self._drift + self._spread * normals(u[:, 0])
        entering = logarithm if self.geometric else np.exp(logarithm)
        return np.stack([logarithm, states[:, 1] + (entering - states[:, 1]) / t], axis=1)

    def reward(self, t: int, states: Array) -> Any:
        """At the end, what the mean exceeds the strike by."""
        if t < self.steps:
            return None
        mean = np.exp(states[:, 1]) if self.geometric else states[:, 1]
        return self._discount * np.maximum(mean - self.strike, 0.0)
