"""Mixtures of densities: counts of points, drawing, and values that never leave the range of floats."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from evenlight.importance.densities import as_density
from evenlight.importance.densities.density import Array

__all__ = ["Mixture", "Sample", "counts"]


class Sample(NamedTuple):
    """Points of a mixture with everything estimates are made of; rows are scaled, which no ratio notices."""

    x: Array
    """Points, shape (n, d)."""
    component: Any
    """The component each point was drawn from, shape (n,)."""
    q: Array
    """Densities of the components, shape (n, J), each row over its largest."""
    target: Array
    """The target's density, shape (n,), over the same."""


def counts(alpha: Array, n: int) -> Any:
    """Numbers of points n_j near n alpha_j that add up to n: differences of rounded cumulative sums."""
    ends = np.rint(n * np.cumsum(alpha) / alpha.sum()).astype(np.int64)
    ends[-1] = n
    return np.diff(ends, prepend=0)


class Mixture:
    """Densities q_j to draw from, and the target p they stand in for.

    Parameters
    ----------
    target : density
        p, normalized.
    proposals : sequence of densities
        q_1 to q_J.
    """

    def __init__(self, target: Any, proposals: Sequence[Any]) -> None:
        self.target = as_density(target)
        if not np.iterable(proposals):
            raise TypeError(f"proposals must be a list of densities, not {type(proposals).__name__}")
        self.proposals = [as_density(proposal) for proposal in proposals]
        if not self.proposals:
            raise ValueError("a mixture needs at least one proposal")
        self.d = self.target.d
        for number, proposal in enumerate(self.proposals):
            if proposal.d != self.d:
                raise ValueError(f"proposal {number} has {proposal.d} dimensions, the target {self.d}")
        self.uniforms = 1 + max(proposal.uniforms for proposal in self.proposals)

    def __len__(self) -> int:
        """The number of components."""
        return len(self.proposals)

    def draw(self, alpha: Array, u: Array) -> Sample:
        """Points from uniform numbers of shape (n, uniforms), the first of which chooses the component.

        Evenly spread points choose components evenly, so that the numbers of points are nearly n alpha_j.
        """
        ends = np.cumsum(alpha / alpha.sum())
        ends[-1] = 1.0
        return self.at(np.searchsorted(ends, u[:, 0], side="right"), u[:, 1:])

    def at(self, component: Any, u: Array) -> Sample:
        """Points of given components from uniform numbers of shape (n, uniforms - 1)."""
        x = np.empty((len(u), self.d))
        for number, proposal in enumerate(self.proposals):
            chosen = component == number
            if chosen.any():
                x[chosen] = proposal.sample(u[chosen, : proposal.uniforms])
        return self._sample(x, component)

    def _sample(self, x: Array, component: Any) -> Sample:
        logs = np.empty((len(self), len(x)))
        for number, proposal in enumerate(self.proposals):
            logs[number] = proposal.logpdf(x)
        largest = logs.max(axis=0)
        logs -= largest
        np.exp(logs, out=logs)
        return Sample(x, component, logs.T, np.exp(self.target.logpdf(x) - largest))
