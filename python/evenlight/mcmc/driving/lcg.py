"""Small multiplicative generators of prime modulus, used as a whole, with random shifts: lattices that drive chains."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer

from .protocol import Array, Driving, Stream, shifts

__all__ = ["LCG"]

# m: the largest prime below 2^m, and its multiplier (P. L'Ecuyer 1999, table 2).
_TABLE = {
    10: (1021, 65),
    11: (2039, 995),
    12: (4093, 209),
    13: (8191, 884),
    14: (16381, 572),
    15: (32749, 219),
    16: (65521, 17364),
    17: (131071, 43165),
    18: (262139, 92717),
    19: (524287, 283741),
    20: (1048573, 380985),
    21: (2097143, 360889),
    22: (4194301, 914334),
    23: (8388593, 653276),
    24: (16777213, 6423135),
}


@dataclass(frozen=True)
class LCG(Driving):
    """All numbers of a small multiplicative congruential generator, in overlapping rows, and the row of zeros.

    The rows are a lattice; a random shift modulo 1 of each column makes every number uniform, and its repetitions are
    the replicates. As p - 1 is even, steps of an even number of uniform numbers skip one. Choose `LFSR` for smooth
    problems, this one for a second opinion or if its length suits better.

    Parameters
    ----------
    m : int
        10 to 24; the chain has as many steps as the modulus, the largest prime p < 2^m.

    Raises
    ------
    TypeError, ValueError
        If there is no such generator.

    Notes
    -----
    What is proven of chains so driven is said of `LFSR`. The multipliers are primitive roots; in 2 to 5 dimensions the
    lattices reach 67 % or more of the best possible distance between planes [1]_.

    References
    ----------
    .. [1] P. L'Ecuyer, "Tables of linear congruential generators of different sizes and good lattice structure",
       Math. Comput. 68(225), 249-260 (1999).
    .. [2] A. B. Owen and S. D. Tribble, "A quasi-Monte Carlo Metropolis algorithm", PNAS 102(25), 8844-8849 (2005).

    Examples
    --------
    >>> from evenlight.mcmc import LCG
    >>> LCG(10).length(2), (LCG(10).numbers(0, 4) * 1021).round().tolist()
    (1021, [1.0, 65.0, 141.0, 997.0])
    """

    name: ClassVar[str] = "lcg"

    m: int

    def __post_init__(self) -> None:
        if integer("m", self.m, 10) not in _TABLE:
            raise ValueError(f"m must be 10 to {max(_TABLE)}, not {self.m}")

    @property
    def period(self) -> int:
        """How many different numbers there are: p - 1."""
        return _TABLE[self.m][0] - 1

    def length(self, dims: int) -> int:
        """p: all rows must be used."""
        del dims
        return self.period + 1

    def numbers(self, start: int, stop: int) -> Array:
        """Numbers `start` to `stop` of the generator, in (0, 1), without a shift; the period repeats."""
        return np.asarray(self._states(start, stop) / (self.period + 1))

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """Rows of the generator, the one of zeros first, with a shift for each replicate and column."""
        if n != self.length(dims):
            raise ValueError(f"the generator has {self.length(dims)} steps, all of them to be used, not {n}")
        padded = dims
        while math.gcd(padded, self.period) > 1:
            padded += 1
        offsets = shifts(dims, replicates, seed)[:, None, :]

        def steps(start: int, stop: int) -> Array:
            rows = self.numbers(max(start - 1, 0) * padded, max(stop - 1, 0) * padded).reshape(-1, padded)[:, :dims]
            if start == 0 < stop:
                rows = np.concatenate([np.zeros((1, dims)), rows])
            shifted = rows + offsets
            return np.asarray(np.where(shifted >= 1, shifted - 1, shifted))

        return steps

    def _states(self, start: int, stop: int) -> NDArray[np.int64]:
        """Jump to the first state, then double their number by jumps of all of them."""
        modulus, multiplier = _TABLE[self.m]
        states = np.array([pow(multiplier, start % self.period, modulus)], np.int64)
        while len(states) < stop - start:
            states = np.concatenate([states, states * pow(multiplier, len(states), modulus) % modulus])
        return states[: max(stop - start, 0)]
