"""Quasi-Monte Carlo: one fixed point set, a value, and no error claimed."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np

from evenlight.estimate import Estimate
from evenlight.integrand import Integrand, rows_per_block

__all__ = ["QuasiMonteCarlo"]


class QuasiMonteCarlo:
    """The mean over fixed, evenly spread points. It says nothing about its error; choose "rqmc" if that matters.

    The error falls nearly as 1/n for integrands of bounded variation in the sense of Hardy and Krause.
    Reference: H. Niederreiter, *Random Number Generation and Quasi-Monte Carlo Methods* (1992).
    """

    name: ClassVar[str] = "qmc"
    first: ClassVar[int] = 1024
    has_error: ClassVar[bool] = False
    copies: ClassVar[int] = 1

    def __init__(self, integrand: Integrand, points: Any, replicates: int) -> None:
        del replicates
        self._integrand = integrand
        self._points = points
        self._rows = 0
        self._used = 0
        self._mean: Any = 0.0

    def resume(self, estimate: Estimate) -> None:
        """Begin where the run that made an estimate ended."""
        self._rows = self._used = estimate.n
        self._mean = np.asarray(estimate.value)

    def extend(self, rows: int) -> None:
        """Evaluate all rows up to `rows`."""
        block = rows_per_block(int(self._points.d))
        while self._rows < rows:
            start, stop = self._rows, min(self._rows + block, rows)
            values, finite = self._integrand(self._points.points(start, stop), start)
            used = stop - start if finite is None else int(finite.sum())
            if used:
                self._used += used
                self._mean = self._mean + (values.sum(axis=0) - used * self._mean) / self._used
            self._rows = stop

    def estimate(self) -> Estimate:
        """The mean; its error is NaN, which means unknown."""
        if not self._used:
            raise ValueError(f"f is finite at none of {self._rows} points")
        value = np.asarray(self._mean)
        return Estimate(
            value=float(value) if value.ndim == 0 else value,
            standard_error=math.nan if value.ndim == 0 else np.full_like(value, math.nan),
            n=self._used,
            replicates=1,
            cost=float(self._rows),
            method=self.name,
            message="deterministic points: no error is claimed",
            diagnostics={"points": (repr(self._points),)},
        )
