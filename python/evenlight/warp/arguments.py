"""What the faces of the warps check before the core works."""

import operator
import os
from typing import Any, SupportsIndex, TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["Floats", "SeedLike", "integer", "real_array", "scramble_name", "seed_number", "threads"]

Floats: TypeAlias = npt.NDArray[np.float64]
"""Double precision."""

SeedLike: TypeAlias = SupportsIndex | np.random.Generator | None
"""A number from 0 on, a generator to draw one from, or None for 0."""


def integer(name: str, value: SupportsIndex, least: int, most: int = 2**64 - 1) -> int:
    """Return an integer within its bounds, or say which argument is wrong and what is allowed."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if not least <= number <= most:
        raise ValueError(f"{name} must be from {least} to {most}, not {number}")
    return number


def seed_number(seed: SeedLike) -> int:
    """Return a seed as a 64-bit number; larger ones are hashed."""
    if seed is None:
        return 0
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(2**64, dtype=np.uint64))
    if operator.index(seed) >= 2**64:
        return int(np.random.SeedSequence(operator.index(seed)).generate_state(1, np.uint64)[0])
    return integer("seed", seed, 0)


def threads(workers: SupportsIndex) -> int:
    """Return a number of threads; -1 is all processors."""
    number = integer("workers", workers, -1)
    if number == 0:
        raise ValueError("workers must be at least 1, or -1 for all processors, not 0")
    return number if number > 0 else os.cpu_count() or 1


def scramble_name(scramble: str | bool | None) -> str:
    """Return the name of a scramble: "none" for None and False, "owen" for True."""
    if scramble is None or scramble is False:
        return "none"
    if scramble is True:
        return "owen"
    if not isinstance(scramble, str):
        raise TypeError(f"scramble must be a string, a bool or None, not {type(scramble).__name__}")
    return scramble


def real_array(name: str, values: Any, shape: tuple[int | None, ...]) -> Floats:
    """Return a finite C-contiguous array of float64 whose sides are as given; None is any side of at least 1."""
    array = np.ascontiguousarray(values, dtype=np.float64)
    fits = array.ndim == len(shape) and all(
        wanted in (None, side) and side > 0 for wanted, side in zip(shape, array.shape, strict=True)
    )
    if not fits:
        wanted = ", ".join("*" if side is None else str(side) for side in shape)
        raise ValueError(f"{name} must have shape ({wanted}), not {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite")
    return array
