"""The order of numbers, faster than NumPy's, and the same on every processor."""

from __future__ import annotations

import numpy as np

from .sort import Array, Indices

__all__ = ["ascending"]

_MAGNITUDE = np.int64(0x7FFF_FFFF_FFFF_FFFF)


def ascending(x: Array) -> Indices:
    """The order of numbers, shape (n,), to 52 - log2(n) binary digits; equal ones keep their places.

    Doubles become integers of the same order, whose last digits make room for the index: sorting them, which takes a
    third of the time of sorting indices, sorts both.
    """
    place = (1 << (len(x) - 1).bit_length()) - 1
    bits = np.ascontiguousarray(x).view(np.int64)
    keys = bits >> 63
    keys &= _MAGNITUDE
    keys ^= bits
    keys &= ~place
    keys |= np.arange(len(x))
    keys.sort()
    keys &= place
    return keys
