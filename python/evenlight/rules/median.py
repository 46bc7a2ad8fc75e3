"""The median of replicates: robust against a few bad ones, and for smooth integrands faster than their mean."""

from __future__ import annotations

from typing import Any, ClassVar

from evenlight.estimate import Estimate, from_moments
from evenlight.integrand import Integrand
from evenlight.medians import Medians
from evenlight.replicate_means import ReplicateMeans

__all__ = ["Median"]


class Median:
    """The median over R replicates; of independent points it is the median of means.

    With linear scrambles a few bad matrices make most of the error of the mean, and the median leaves them out: its
    error falls faster than any power of n for analytic integrands (Z. Pan and A. B. Owen, Math. Comp. 92, 805-837,
    2023). With independent points its intervals are sub-Gaussian for every integrand of finite variance
    (G. Lugosi and S. Mendelson, Found. Comput. Math. 19, 1145-1190, 2019). It is biased where replicates are skewed.

    The standard error is that of a median of normal replicates, with their spread from the median absolute deviation;
    where the replicates have heavy tails it is far too large rather than too small.
    """

    name: ClassVar[str] = "median"
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
        """The median of the replicates, and what its standard error is if they are normal."""
        state = self._replicates
        state.check_used()
        return from_moments(
            ((state.rows, Medians(state.means)),),
            method=self.name,
            cost=float(state.rows * state.replicates),
            diagnostics={"points": (repr(state.points),), "replicates": state.means},
        )
