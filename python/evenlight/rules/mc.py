"""Plain Monte Carlo: independent points, and the central limit theorem for the error."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from evenlight.estimate import Estimate, from_moments
from evenlight.integrand import Integrand, rows_per_block
from evenlight.moments import Moments

__all__ = ["MonteCarlo"]


class MonteCarlo:
    """The mean of values at independent points; every value is a replicate. Choose it for rough or unknown integrands.

    The error falls as n^(-1/2), whatever the dimension.
    Reference: A. B. Owen, *Monte Carlo theory, methods and examples*, chapter 2.
    """

    name: ClassVar[str] = "mc"
    first: ClassVar[int] = 1024
    has_error: ClassVar[bool] = True
    copies: ClassVar[int] = 1

    def __init__(self, integrand: Integrand, points: Any, replicates: int) -> None:
        del replicates  # each point is one
        self._integrand = integrand
        self._points = points
        self._rows = 0
        self._moments = Moments.of(np.empty(0))

    def resume(self, estimate: Estimate) -> None:
        """Begin where the run that made an estimate ended."""
        self._rows, self._moments = round(estimate.cost), estimate.moments()

    def extend(self, rows: int) -> None:
        """Evaluate all rows up to `rows`."""
        block = rows_per_block(int(self._points.d))
        while self._rows < rows:
            start, stop = self._rows, min(self._rows + block, rows)
            values, finite = self._integrand(self._points.points(start, stop), start)
            self._moments = self._moments.merge(Moments.of(values if finite is None else values[finite]))
            self._rows = stop

    def estimate(self) -> Estimate:
        """The mean, and the standard deviation over the root of n."""
        if not self._moments.count:
            raise ValueError(f"f is finite at none of {self._rows} points")
        diagnostics: dict[str, Any] = {"points": (repr(self._points),)}
        return from_moments(((1, self._moments),), method=self.name, cost=float(self._rows), diagnostics=diagnostics)
