"""Arguments that many calls take: integers, seeds, threads, functions; what is wrong with one is said by its name."""

from __future__ import annotations

import operator
import os
from typing import Any, SupportsIndex, TypeAlias

import numpy as np

__all__ = ["WORD", "SeedLike", "check_callable", "check_domain", "check_points", "integer", "seed_number", "threads"]

WORD = 2**64 - 1
"""The largest number that the core takes."""

SeedLike: TypeAlias = SupportsIndex | np.random.Generator | None
"""A number from 0 on, a generator to draw one from, or None for 0."""


def check_callable(name: str, thing: Any) -> None:
    """Raise a TypeError if an argument is no function."""
    if not callable(thing):
        raise TypeError(f"{name} must be a function, not {type(thing).__name__}")


def check_domain(name: str, domain: Any) -> None:
    """Raise a TypeError if an argument is no domain: a thing, no class, with `d`, `map(u)` and `volume`."""
    if isinstance(domain, type):
        raise TypeError(f"{name} must be a domain, {domain.__name__}(…), not its class")
    if not (hasattr(domain, "d") and hasattr(domain, "volume") and callable(getattr(domain, "map", None))):
        raise TypeError(f"{name} must be a domain such as evenlight.domains.Box, not {type(domain).__name__}")


def check_points(points: Any) -> None:
    """Raise a TypeError if an argument is no sequence of points that knows its dimensions and gives any rows."""
    if isinstance(points, type):
        raise TypeError(f"points must be a sequence of so many dimensions, {points.__name__}(d), not its class")
    if not (hasattr(points, "d") and callable(getattr(points, "points", None))):
        kind = f"{type(points).__module__}.{type(points).__qualname__}"
        raise TypeError(f"points must be a sequence such as evenlight.points.Sobol(d), not {kind}")


def integer(name: str, value: SupportsIndex, least: int, most: int | None = None) -> int:
    """Return an integer within its bounds, or say which argument is none and what is allowed."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if number < least or (most is not None and number > most):
        low = number < least and most in (None, WORD)
        allowed = f"at least {least}" if low else f"from {least} to {most}"
        raise ValueError(f"{name} must be {allowed}, not {number}")
    return number


def seed_number(seed: SeedLike) -> int:
    """Return a seed as a 64-bit number; larger ones are hashed."""
    if seed is None:
        return 0
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(2**64, dtype=np.uint64))
    number = integer("seed", seed, 0)
    return number if number < 2**64 else int(np.random.SeedSequence(number).generate_state(1, np.uint64)[0])


def threads(workers: SupportsIndex) -> int:
    """Return a number of threads; -1 is all processors."""
    number = integer("workers", workers, -1)
    if number == 0:
        raise ValueError("workers must be at least 1, or -1 for all processors, not 0")
    return number if number > 0 else os.cpu_count() or 1
