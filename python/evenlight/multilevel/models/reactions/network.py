"""Networks of reactions: which change what, and how often; as continuous-time Markov chains on counts of molecules."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["ReactionNetwork"]

Array = NDArray[np.float64]


class ReactionNetwork:
    """R reactions among S species.

    Parameters
    ----------
    changes : array_like of int, shape (R, S)
        What each reaction adds to the counts.
    rates : callable
        From counts, shape (S, n), to the rates of the reactions, shape (R, n), or R arrays and numbers that broadcast
        to (n,). A rate must be 0 wherever its reaction would make a count negative. Negative rates count as 0.
    start : array_like of int, shape (S,)
        Counts at time 0.
    name : str
        In messages.

    Raises
    ------
    ValueError
        If shapes do not fit, or counts are no whole numbers from 0 on.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import ReactionNetwork
    >>> births_and_deaths = ReactionNetwork([[1], [-1]], lambda x: (10.0, x[0]), [0])
    >>> births_and_deaths.propensities(np.array([[4.0, 7.0]]))
    array([[10., 10.],
           [ 4.,  7.]])
    """

    def __init__(
        self, changes: Any, rates: Callable[[Array], Any], start: Any, *, name: str = "reaction network"
    ) -> None:
        self.name = name
        self.changes = np.asarray(changes, np.float64)
        self.start = np.asarray(start, np.float64)
        self._rates = rates
        if self.changes.ndim != 2 or self.start.shape != self.changes.shape[1:]:
            shapes = f"{self.changes.shape} and {self.start.shape}"
            raise ValueError(f"changes and start must have shapes (reactions, species) and (species,), not {shapes}")
        if (self.changes % 1.0).any() or (self.start % 1.0).any() or (self.start < 0.0).any():
            raise ValueError("changes and start must be whole numbers, those of start from 0 on")
        self.propensities(self.start[:, np.newaxis])

    @property
    def reactions(self) -> int:
        """How many there are."""
        return len(self.changes)

    def propensities(self, x: Array) -> Array:
        """The rates at counts of shape (S, n), shape (R, n)."""
        rates = self._rates(x)
        if len(rates) != self.reactions:
            raise ValueError(f"{self.name}: rates must be {self.reactions}, one for each reaction, not {len(rates)}")
        out = np.empty((self.reactions, x.shape[1]))
        for row, rate in zip(out, rates, strict=True):
            row[:] = rate
        return np.maximum(out, 0.0, out=out)

    def beginning(self, n: int) -> Array:
        """The counts of n paths at time 0, shape (S, n)."""
        return np.repeat(self.start[:, np.newaxis], n, axis=1)
