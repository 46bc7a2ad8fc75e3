"""European call: the price at the end above the strike. The first to try; all smoothness there is to have."""

from __future__ import annotations

import numpy as np

from evenlight.multilevel.models.option import black_scholes_call
from evenlight.multilevel.models.path import Path

from .payoff import Array, Payoff

__all__ = ["European"]


class European(Payoff):
    """Discounted (S_T - K)^+. Variance exponents: 1 with Euler's scheme, 2 with Milstein's."""

    name = "european"
    cite = "M. B. Giles, Oper. Res. 56(3), 607-617 (2008)"

    def plain(self, path: Path) -> Array:
        """From the last value."""
        gain = path.values[-1] - self.option.strike
        return np.asarray(np.maximum(gain, 0.0, out=gain) * self.option.discount)

    def smooth(self, path: Path) -> Array:
        """The same: nothing happens between grid points that matters."""
        return self.plain(path)

    def exact(self) -> float:
        """Black and Scholes."""
        return black_scholes_call(self.option)
