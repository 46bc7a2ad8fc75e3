"""Antithetic pairs of chains: one by u, the other by 1 - u. When functions are monotone in the uniform numbers."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from evenlight.points import Independent

from .protocol import Array, Driving, Stream

__all__ = ["Antithetic"]


@dataclass(frozen=True)
class Antithetic(Driving):
    """Pairs of chains with opposite numbers; a replicate is a pair.

    Each chain by itself has independent numbers, so that every kernel keeps its target, and what is known of its
    convergence holds. For Gibbs samplers whose quantile functions are monotone, the errors of the two chains cancel in
    part; for functions symmetric under u to 1 - u a pair is worth one chain.

    Parameters
    ----------
    points : Driving, optional
        What drives the first chain of each pair, with no coupling of its own; independent numbers by default.

    Raises
    ------
    TypeError, ValueError
        If it is no driving sequence, or couples chains itself.

    References
    ----------
    .. [1] A. Frigessi, J. Gåsemyr and H. Rue, "Antithetic coupling of two Gibbs sampler chains", Ann. Stat. 28(4),
       1128-1149 (2000).

    Examples
    --------
    >>> from evenlight.mcmc import Antithetic
    >>> pair = Antithetic().stream(dims=2, n=10, replicates=1, seed=1)(0, 10)
    >>> bool((pair[0] + pair[1] == 1).all())
    True
    """

    name: ClassVar[str] = "antithetic"

    points: Driving | None = None
    coupled: int = field(default=2, init=False)

    def __post_init__(self) -> None:
        if self.points is not None and not isinstance(self.points, Driving):
            raise TypeError(f"points must be a driving sequence, not {type(self.points).__name__}")
        if self.points is not None and self.points.coupled != 1:
            raise ValueError(f"{self.points!r} couples {self.points.coupled} chains already")

    @property
    def independent_steps(self) -> bool:
        """As those of the first chain."""
        return self.points is None or self.points.independent_steps

    def length(self, dims: int) -> int | None:
        """As many steps as the first chain has."""
        return None if self.points is None else self.points.length(dims)

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """Opposite numbers side by side; the opposite of 0 is the last number before 1."""
        points = self.points
        first = _independent(dims, replicates, seed) if points is None else points.stream(dims, n, replicates, seed)

        def steps(start: int, stop: int) -> Array:
            u = first(start, stop)
            pairs = np.stack([u, np.minimum(1 - u, 1 - 2.0**-53)], axis=1)
            return pairs.reshape(-1, *u.shape[1:])

        return steps


def _independent(dims: int, replicates: int, seed: int) -> Stream:
    points = Independent(dims, seed=seed)
    return lambda start, stop: points.points(start, stop, replicates=replicates)
