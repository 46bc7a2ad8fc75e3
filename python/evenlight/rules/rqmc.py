"""Randomized quasi-Monte Carlo: the spread of independent replicates is the error."""

from __future__ import annotations

from typing import Any, ClassVar

from evenlight.estimate import Estimate, from_moments
from evenlight.integrand import Integrand
from evenlight.moments import Moments
from evenlight.replicate_means import ReplicateMeans

__all__ = ["RandomizedQuasiMonteCarlo"]


class RandomizedQuasiMonteCarlo:
    """The mean of R replicates: the same points under independent randomizations. The default.

    The points of one replicate are not independent, and their spread says nothing; the replicates are. The error of
    scrambled nets falls nearly as n^(-3/2) for smooth integrands and faster than n^(-1/2) for all square-integrable
    ones.
    Reference: A. B. Owen, Ann. Stat. 25(4), 1541-1562 (1997).
    """

    name: ClassVar[str] = "rqmc"
    first: ClassVar[int] = 128
    has_error: ClassVar[bool] = True

    def __init__(self, integrand: Integrand, points: Any, replicates: int) -> None:
        self._replicates = ReplicateMeans(integrand, points, replicates)

    @property
    def copies(self) -> int:
        """The number of replicates."""
        return self._replicates.replicates

    def resume(self, estimate: Estimate) -> None:
        """Begin where the run that made an estimate ended."""
        self._replicates.resume(round(estimate.cost) // self.copies, estimate.diagnostics["replicates"])

    def extend(self, rows: int) -> None:
        """Evaluate all rows up to `rows` of every replicate."""
        self._replicates.extend(rows)

    def estimate(self) -> Estimate:
        """The mean of the replicates, and its standard error from their spread."""
        state = self._replicates
        state.check_used()
        diagnostics = {"points": (repr(state.points),), "replicates": state.means}
        groups = ((state.rows, Moments.of(state.means)),)
        cost = float(state.rows * state.replicates)
        return from_moments(groups, method=self.name, cost=cost, diagnostics=diagnostics)
