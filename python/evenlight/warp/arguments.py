"""What the faces of the warps check before the core works."""

from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["Floats", "real_array", "scramble_name"]

Floats: TypeAlias = npt.NDArray[np.float64]
"""Double precision."""


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
