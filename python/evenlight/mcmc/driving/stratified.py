"""Stratified chains: at every step, the numbers of k chains are a Latin hypercube. For many chains run side by side."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from evenlight.arguments import integer
from evenlight.points import Independent

from .protocol import Array, Driving, Stream

__all__ = ["Stratified"]


@dataclass(frozen=True)
class Stratified(Driving):
    """Groups of k chains whose numbers at each step and coordinate lie one in each of k slices; a group is a replicate.

    Each chain by itself has independent numbers, so that every kernel keeps its target, and what is known of its
    convergence holds. The gain is in what one step's numbers decide: large while chains spread from a common start and
    for chains that forget quickly, small in long runs of chains that remember.

    Parameters
    ----------
    coupled : int
        k, at least 2.

    Raises
    ------
    TypeError, ValueError
        If it is not as above.

    References
    ----------
    .. [1] R. V. Craiu and X.-L. Meng, "Multiprocess parallel antithetic coupling for backward and forward Markov chain
       Monte Carlo", Ann. Stat. 33(2), 661-697 (2005).

    Examples
    --------
    >>> from evenlight.mcmc import Stratified
    >>> numbers = Stratified(8).stream(dims=2, n=10, replicates=1, seed=1)(0, 10)
    >>> sorted((numbers[:, 3, 1] * 8).astype(int).tolist())
    [0, 1, 2, 3, 4, 5, 6, 7]
    """

    name: ClassVar[str] = "stratified"

    coupled: int = 16

    def __post_init__(self) -> None:
        integer("coupled", self.coupled, 2)

    @property
    def independent_steps(self) -> bool:
        """Yes: of each chain by itself."""
        return True

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """Slices by the ranks of independent numbers, places in them by others."""
        del n
        points = Independent(2 * dims, seed=seed)

        def steps(start: int, stop: int) -> Array:
            numbers = points.points(start, stop, replicates=replicates * self.coupled)
            groups = numbers.reshape(replicates, self.coupled, stop - start, 2 * dims)
            ranks = groups[..., :dims].argsort(axis=1).argsort(axis=1)
            placed = np.minimum((ranks + groups[..., dims:]) / self.coupled, 1 - 2.0**-53)
            return np.asarray(placed.reshape(-1, stop - start, dims))

        return steps
