"""Full-period linear feedback shift registers with digital shifts: the best numbers to drive smooth Gibbs chains by."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer

from .protocol import Array, Driving, Stream, shifts

__all__ = ["LFSR"]

Words = NDArray[np.uint32]

_WORD = 32  # bits of a number

# m: exponents e of b_(i+m) = sum of b_(i+e) modulo 2, and g: number i begins with bit i g.
_CHEN = {
    10: ((0, 3), 115),
    11: ((0, 2), 291),
    12: ((0, 1, 4, 6), 172),
    13: ((0, 1, 3, 4), 267),
    14: ((0, 1, 3, 5), 332),
    15: ((0, 1), 388),
    16: ((0, 2, 3, 5), 283),
    17: ((0, 3), 514),
    18: ((0, 7), 698),
    19: ((0, 1, 2, 5), 706),
    20: ((0, 3), 1304),
    21: ((0, 2), 920),
    22: ((0, 1), 1336),
    23: ((0, 5), 1236),
    24: ((0, 1, 3, 4), 1511),
    25: ((0, 3), 1445),
    26: ((0, 1, 2, 6), 1906),
    27: ((0, 1, 2, 5), 1875),
    28: ((0, 3), 2573),
    29: ((0, 2), 2633),
    30: ((0, 1, 4, 6), 2423),
    31: ((0, 3), 3573),
    32: ((0, 2, 6, 7), 3632),
}
_HARASE = {
    10: ((0, 6, 7, 9), 70),
    11: ((0, 1, 4, 7, 8, 10), 179),
    12: ((0, 1, 2, 3, 4, 7, 10, 11), 146),
    13: ((0, 1, 2, 4, 8, 10, 11, 12), 139),
    14: ((0, 2, 4, 5, 7, 8, 9, 10, 12, 13), 5192),
    15: ((0, 1, 3, 4, 7, 8, 9, 11, 13, 14), 1028),
    16: ((0, 1, 3, 5, 6, 7, 8, 9, 12, 15), 12749),
}
_TABLES = {"harase": _HARASE, "chen": _CHEN}


@dataclass(frozen=True)
class LFSR(Driving):
    """All 2^m - 1 numbers of a linear feedback shift register, in overlapping rows, and the row of zeros.

    Step i takes the numbers from i s on, s the number of uniform numbers of a step (or a few more, if need be, for
    it to have no factor in common with the period): every one of 2^m overlapping rows once. A random digital shift of
    each column makes every number uniform; its repetitions are the replicates.

    Parameters
    ----------
    m : int
        10 to 32; the chain has 2^m steps.
    table : {"harase", "chen"}, optional
        Harase's registers [2]_, m = 10 to 16, with the least t-values in 2 to 5 dimensions; those of Chen et al. [1]_,
        m = 10 to 32. By default Harase's where they exist.

    Raises
    ------
    TypeError, ValueError
        If there is no such register.

    Notes
    -----
    In the limit of m these arrays are completely uniformly distributed. Means over chains driven by such numbers are
    known to converge for Metropolis–Hastings on finite spaces [3]_, and on continuous ones for chains that contract,
    such as some Gibbs samplers [4]_. Nothing is proven for other kernels: compare with independent numbers. Gains are
    large for smooth functions and few numbers a step, small where acceptance decides.

    References
    ----------
    .. [1] S. Chen, M. Matsumoto, T. Nishimura and A. B. Owen, "New inputs and methods for Markov chain quasi-Monte
       Carlo", Monte Carlo and Quasi-Monte Carlo Methods 2010, 313-327 (2012).
    .. [2] S. Harase, "A table of short-period Tausworthe generators for Markov chain quasi-Monte Carlo", J. Comput.
       Appl. Math. 384, 113136 (2021).
    .. [3] A. B. Owen and S. D. Tribble, "A quasi-Monte Carlo Metropolis algorithm", PNAS 102(25), 8844-8849 (2005).
    .. [4] S. Chen, J. Dick and A. B. Owen, "Consistency of Markov chain quasi-Monte Carlo on continuous state spaces",
       Ann. Stat. 39(2), 673-701 (2011).

    Examples
    --------
    >>> from evenlight.mcmc import LFSR
    >>> LFSR(10, table="chen").numbers(0, 4).round(7)
    array([0.5004926, 0.8886435, 0.7536907, 0.8506772])
    """

    name: ClassVar[str] = "lfsr"

    m: int
    table: str | None = None

    def __post_init__(self) -> None:
        m = integer("m", self.m, 10)
        if self.table is None:
            object.__setattr__(self, "table", "harase" if m in _HARASE else "chen")
        if self.table not in _TABLES:
            raise ValueError(f"unknown table {self.table!r}; known: {', '.join(_TABLES)}")
        known = _TABLES[self.table]
        if m not in known:
            raise ValueError(f"the table {self.table!r} has m = {min(known)} to {max(known)}, not {m}")

    @property
    def period(self) -> int:
        """How many different numbers there are: 2^m - 1."""
        return (1 << self.m) - 1

    def length(self, dims: int) -> int:
        """2^m: all rows must be used."""
        del dims
        return 1 << self.m

    def numbers(self, start: int, stop: int) -> Array:
        """Numbers `start` to `stop` of the register, in (0, 1), without a shift; the period repeats."""
        return np.asarray(self._words(start, stop) * 2.0**-_WORD)

    def stream(self, dims: int, n: int, replicates: int, seed: int) -> Stream:
        """Rows of the register, the one of zeros first, with a digital shift for each replicate and column."""
        if n != self.length(dims):
            raise ValueError(
                f"the register of m = {self.m} has {self.length(dims)} steps, all of them to be used, not {n}"
            )
        padded = dims
        while math.gcd(padded, self.period) > 1:
            padded += 1
        keys = (shifts(dims, replicates, seed) * 2.0**53).astype(np.uint64)[:, None, :]

        def steps(start: int, stop: int) -> Array:
            words = self._words(max(start - 1, 0) * padded, max(stop - 1, 0) * padded).reshape(-1, padded)[:, :dims]
            if start == 0 < stop:
                words = np.concatenate([np.zeros((1, dims), np.uint32), words])
            digits = (words.astype(np.uint64) << np.uint64(53 - _WORD)) ^ keys
            return np.asarray(digits * 2.0**-53)

        return steps

    def _words(self, start: int, stop: int) -> Words:
        """Words of numbers `start` to `stop`: jump to the first, then double their number by jumps of all of them."""
        taps, stride = _TABLES[str(self.table)][self.m]
        next_word = _power(_next_word(self.m, taps), stride)
        first = np.array([_first_word(self.m, taps)], np.uint32)
        words = _apply(_power(next_word, start % self.period), first)
        jump = next_word
        while len(words) < stop - start:
            words = np.concatenate([words, _apply(jump, words)])
            jump = _times(jump, jump)
        return words[: max(stop - start, 0)]


def _first_word(m: int, taps: tuple[int, ...]) -> int:
    """Bits b_0 = 1, b_1 = ... = b_(m-1) = 0 and their successors, the first bit in front."""
    bits = [1] + [0] * (m - 1)
    while len(bits) < _WORD:
        bits.append(sum(bits[len(bits) - m + tap] for tap in taps) % 2)
    return int("".join(map(str, bits)), 2)


def _next_word(m: int, taps: tuple[int, ...]) -> Words:
    """The linear map of a word to the one that begins a bit later, as images of the bits, first bit first."""
    images = [0] + [1 << (_WORD - bit) for bit in range(1, _WORD)]
    for tap in taps:  # the new last bit is a sum of bits of the word
        images[_WORD - m + tap] ^= 1
    return np.array(images, np.uint32)


def _apply(images: Words, words: Words) -> Words:
    """A linear map of many words, by a table for each of their bytes."""
    found = np.zeros_like(words)
    for byte in range(4):
        table = np.zeros(1, np.uint32)
        for image in images[8 * byte : 8 * byte + 8][::-1]:  # the last bit is the lowest of the byte
            table = np.concatenate([table, table ^ image])
        found ^= table[(words >> np.uint32(24 - 8 * byte)) & np.uint32(255)]
    return found


def _times(a: Words, b: Words) -> Words:
    """The map that does b, then a."""
    return _apply(a, b)


def _power(images: Words, exponent: int) -> Words:
    found = np.uint32(1) << np.arange(_WORD - 1, -1, -1, dtype=np.uint32)
    while exponent:
        if exponent & 1:
            found = _times(images, found)
        images = _times(images, images)
        exponent >>= 1
    return found
