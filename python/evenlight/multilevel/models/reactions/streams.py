"""Random numbers without end for each of many paths, from a key: where nobody knows in advance how many it takes.

Number c of a path is a pure function of its key and c, so a path does not depend on which others run beside it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Streams"]

Words = NDArray[np.uint64]

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_ALTERNATING = np.uint64(0xAAAAAAAAAAAAAAAA)


class Streams:
    """One stream of uniform numbers per row.

    SplitMix64: a counter in steps of an odd number, the path's own, hashed. Reference: G. L. Steele, D. Lea and C. H.
    Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014, 453-472.

    Parameters
    ----------
    keys : ndarray, shape (n, 2)
        Uniform numbers in [0, 1).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import Streams
    >>> streams = Streams(np.array([[0.25, 0.5], [0.25, 0.75]]))
    >>> streams.uniforms(0, 3).shape, bool((streams.uniforms(2, 1) == streams.uniforms(0, 3)[2]).all())
    ((3, 2), True)
    """

    def __init__(self, keys: NDArray[np.float64]) -> None:
        words = np.floor(keys.T * 2.0**53).astype(np.uint64)
        start, step = _mixed(words + _GOLDEN)
        self._start: Words = start
        # Odd; with few changes between neighboring bits the hash would show them.
        step |= np.uint64(1)
        dull = np.bitwise_count(step ^ (step >> np.uint64(1))) < 24
        step[dull] ^= _ALTERNATING
        self._step: Words = step

    def uniforms(self, first: int, count: int, rows: Any = slice(None)) -> NDArray[np.float64]:
        """Numbers first, …, first + count - 1 of the paths in `rows`, shape (count, n), each inside (0, 1)."""
        counters = np.arange(first, first + count, dtype=np.uint64)[:, np.newaxis]
        words = _mixed(self._start[rows] + counters * self._step[rows])
        words >>= np.uint64(11)
        numbers = words.astype(np.float64)
        numbers += 0.5
        numbers *= 2.0**-53
        # The last of the 2^53 places would round to 1.
        return np.minimum(numbers, 1.0 - 2.0**-53, out=numbers)


def _mixed(words: Words) -> Words:
    """The finalizer, David Stafford's variant 13, in place."""
    other = words >> np.uint64(30)
    words ^= other
    words *= np.uint64(0xBF58476D1CE4E5B9)
    np.right_shift(words, np.uint64(27), out=other)
    words ^= other
    words *= np.uint64(0x94D049BB133111EB)
    np.right_shift(words, np.uint64(31), out=other)
    words ^= other
    return words
