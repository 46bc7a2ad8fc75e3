"""Targets: a user's log density on blocks of positions, with checks that name the first bad value."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from .kernel import Array, LogDensity, State

__all__ = ["DensityState", "check_between_0_and_1", "check_positive", "density_state", "evaluate", "moved", "positions"]

S = TypeVar("S", bound=State)


@dataclass(frozen=True, eq=False)
class DensityState(State):
    """Positions, and the target there."""

    log_density: Array
    """Shape (chains,)."""


def positions(position: Any) -> Array:
    """Return positions as an array (chains, d) of finite numbers."""
    array = np.asarray(position, np.float64)
    if array.ndim != 2 or 0 in array.shape:
        raise ValueError(f"positions must have the shape (chains, d), not {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError("positions must be finite")
    return array


def evaluate(log_density: LogDensity, x: Array) -> Array:
    """The log density at a block of positions; NaN and +infinity are errors that name the position."""
    values = np.asarray(log_density(x), np.float64)
    if values.shape != (len(x),):
        raise ValueError(f"log_density must return an array of shape ({len(x)},) for {len(x)} rows, not {values.shape}")
    bad = ~(values < np.inf)
    if bad.any():
        row = int(np.argmax(bad))
        raise ValueError(f"log_density is {values[row]} at {x[row].tolist()}")
    return values


def density_state(log_density: LogDensity, position: Any) -> DensityState:
    """The state of chains at positions where the target must not be 0."""
    x = positions(position)
    values = evaluate(log_density, x)
    if np.isneginf(values).any():
        chain = int(np.argmin(values))
        raise ValueError(f"chain {chain} starts at {x[chain].tolist()}, where the target's density is 0")
    return DensityState(x, values)


def moved(state: S, accepted: NDArray[np.bool_], **proposed: Array) -> S:
    """The state with the proposed arrays in the rows that were accepted."""
    rows = {
        name: np.where(accepted.reshape(-1, *[1] * (new.ndim - 1)), new, getattr(state, name))
        for name, new in proposed.items()
    }
    return replace(state, **rows)


def check_between_0_and_1(name: str, value: float) -> None:
    """Raise a ValueError if an argument is not a number between 0 and 1, neither of them."""
    if not 0 < value < 1:
        raise ValueError(f"{name} must be between 0 and 1, not {value}")


def check_positive(name: str, value: float) -> None:
    """Raise a ValueError if an argument is not a finite number above 0."""
    if not 0 < value < np.inf:
        raise ValueError(f"{name} must be finite and above 0, not {value}")
