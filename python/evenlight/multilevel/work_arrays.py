"""Work arrays that are kept from block to block: a fresh array costs a page fault for every 512 of its numbers."""

from __future__ import annotations

import math
import threading

import numpy as np
from numpy.typing import NDArray

__all__ = ["work_array"]

_MOST = 2**18  # numbers that are kept; a larger array is a fresh one


class _Kept(threading.local):
    def __init__(self) -> None:
        self.arrays: dict[str, NDArray[np.float64]] = {}


_KEPT = _Kept()


def work_array(name: str, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """An array of this thread that holds anything; the next call with this name takes its memory again.

    Only for what is used up before any code of a caller runs, which might ask for the same name.
    """
    size = math.prod(shape)
    if size > _MOST:
        return np.empty(shape)
    kept = _KEPT.arrays.get(name)
    if kept is None or kept.size < size:
        kept = _KEPT.arrays[name] = np.empty(size)
    return kept[:size].reshape(shape)
