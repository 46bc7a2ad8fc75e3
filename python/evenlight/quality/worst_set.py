"""A discrepancy that says what it is: a number with its kind and the worst set that is known."""

from typing import Generic, Literal, Protocol, Self, TypeVar

__all__ = ["Kind", "WorstSetDiscrepancy"]

Kind = Literal["exact", "lower", "upper"]


class Evidence(Protocol):
    """What every discrepancy knows besides the number."""

    @property
    def kind(self) -> Kind:
        """Whether the discrepancy is, is at least, or is at most the number."""

    @property
    def closed(self) -> bool:
        """Whether the worst set is closed and has too many points."""


E = TypeVar("E", bound=Evidence)


class WorstSetDiscrepancy(float, Generic[E]):
    """A number with evidence."""

    evidence: E

    def __new__(cls, value: float, evidence: E) -> Self:
        """Attach the evidence to the number."""
        made = super().__new__(cls, value)
        made.evidence = evidence
        return made

    def __getnewargs__(self) -> tuple[float, E]:  # type: ignore[override]
        """What pickle needs."""
        return float(self), self.evidence

    @property
    def value(self) -> float:
        """The number itself."""
        return float(self)

    @property
    def kind(self) -> Kind:
        """Whether the discrepancy is, is at least, or is at most the number."""
        return self.evidence.kind

    @property
    def closed(self) -> bool:
        """Whether the worst set is closed and has too many points; otherwise it is open and has too few."""
        return self.evidence.closed

    def __repr__(self) -> str:
        return f"{type(self).__name__}({float(self)!r}, kind={self.kind!r})"
