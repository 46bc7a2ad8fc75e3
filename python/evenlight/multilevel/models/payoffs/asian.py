"""Asian call: the mean price over time above the strike."""

from __future__ import annotations

import numpy as np

from evenlight.multilevel.models.path import Path

from .payoff import Array, Payoff

__all__ = ["Asian"]


class Asian(Payoff):
    """Discounted (A - K)^+, A the mean of the price over time, by the trapezoidal rule.

    Variance exponents: 1 with Euler's scheme (more on coarse levels), 2 with Milstein's: what the trapezoidal rule
    misses within a step has a standard deviation of the order of the step, as the scheme itself. Sampling it would
    double the random numbers and leave the exponent.
    """

    name = "asian"
    cite = "M. B. Giles, in Monte Carlo and Quasi-Monte Carlo Methods 2006, 343-358 (2008)"

    def plain(self, path: Path) -> Array:
        """From all values."""
        values = path.values
        mean = np.add.reduce(values[1:-1], axis=0)
        mean += 0.5 * (values[0] + values[-1])
        mean /= len(values) - 1
        mean -= self.option.strike
        return np.asarray(np.maximum(mean, 0.0, out=mean) * self.option.discount)

    def smooth(self, path: Path) -> Array:
        """The same."""
        return self.plain(path)

    def exact(self) -> None:
        """There is no formula; 5.76309 ± 0.00005 for the default terms, by Večeř's partial differential equation."""
        return
