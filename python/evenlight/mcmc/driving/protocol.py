"""Driving sequences: the uniform numbers of chains. What all of them do, and what is known of chains they drive."""

from __future__ import annotations

from collections.abc import Callable
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.points import Independent

__all__ = ["Array", "Driving", "Stream", "shifts"]

Array = NDArray[np.float64]

Stream = Callable[[int, int], Array]
"""From steps `start` to `stop` to uniform numbers in [0, 1) of shape (chains, stop - start, dims)."""


class Driving:
    """A source of the uniform numbers of chains.

    Laws: a stream is a pure function of its arguments, whatever the blocks it is asked for; replicates are independent,
    and every number is uniform on [0, 1).
    """

    name: ClassVar[str]
    """Its name in the registry."""
    coupled: int = 1
    """How many chains make one replicate: they are dependent, and lie side by side."""

    @property
    def independent_steps(self) -> bool:
        """Whether the steps of each chain by itself are independent: then all that is known of Markov chains holds."""
        return False

    def length(self, dims: int) -> int | None:
        """How many steps there are; None if there is no end to them. Balanced points must be used as a whole."""
        del dims
        return None

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """Prepare `n` steps of `dims` numbers for `replicates` independent randomizations.

        Parameters
        ----------
        dims : int
            Numbers for each step, at least 1.
        n : int
            Steps.
        replicates : int
            Independent randomizations, each of `coupled` chains.
        seed : int
            Of all of them.

        Returns
        -------
        callable
            From steps `start` and `stop` to an array (replicates * coupled, stop - start, dims).

        Raises
        ------
        ValueError
            If it has no such number of steps, or no such dimensions.
        """
        raise NotImplementedError


def shifts(dims: int, replicates: int, seed: int) -> Array:
    """A uniform number for each replicate and column, shape (replicates, dims)."""
    return np.asarray(Independent(dims, seed=seed).points(0, 1, replicates=replicates)[:, 0])
