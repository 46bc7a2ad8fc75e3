"""Independent uniform numbers: what Markov chains are usually driven by."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from evenlight.points import Independent

from .protocol import Driving, Stream

__all__ = ["IndependentNumbers"]


@dataclass(frozen=True)
class IndependentNumbers(Driving):
    """Independent uniform numbers, a pure function of (seed, chain, step, dimension).

    Examples
    --------
    >>> from evenlight.mcmc import IndependentNumbers
    >>> stream = IndependentNumbers().stream(dims=3, n=100, replicates=2, seed=1)
    >>> stream(10, 20).shape, bool((stream(10, 20)[:, 3:] == stream(13, 20)).all())
    ((2, 10, 3), True)
    """

    name: ClassVar[str] = "independent"

    @property
    def independent_steps(self) -> bool:
        """Yes."""
        return True

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """Numbers of a generator with random access."""
        del n
        points = Independent(dims, seed=seed)
        return lambda start, stop: points.points(start, stop, replicates=replicates)
