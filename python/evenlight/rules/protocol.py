"""What every rule does: take more points, and say what they tell."""

from __future__ import annotations

from typing import Any, ClassVar, Protocol

from evenlight.estimate import Estimate
from evenlight.integrand import Integrand

__all__ = ["Rule"]


class Rule(Protocol):
    """A way from function values to an estimate; it grows, so that a run can go on where it stopped."""

    name: ClassVar[str]
    first: ClassVar[int]
    """Points, of each replicate if there are any, before the first look of a run up to a tolerance."""
    has_error: ClassVar[bool]
    """Whether it can judge its error, and so work up to a tolerance."""

    def __init__(self, integrand: Integrand, points: Any, replicates: int) -> None: ...

    @property
    def copies(self) -> int:
        """How many points a row stands for: the number of replicates, or 1."""
        ...

    def resume(self, estimate: Estimate) -> None:
        """Begin where the run that made an estimate ended."""
        ...

    def extend(self, rows: int) -> None:
        """Evaluate all rows up to `rows`; those evaluated already stay."""
        ...

    def estimate(self) -> Estimate:
        """Say what the rows so far tell."""
        ...
