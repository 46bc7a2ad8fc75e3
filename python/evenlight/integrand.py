"""Integrands: a user's function on blocks of points, with checks that name the first bad value."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_domain

__all__ = ["Integrand"]

Array = NDArray[np.float64]

_MOST_NUMBERS = 2**20  # of a block of points: 8 MB, which caches still help with
_REACTIONS = ("raise", "skip-and-count")


class Integrand:
    """A function of blocks (n, d) with values (n,) or (n, ...), its domain, and what to do about NaN and infinities.

    Parameters
    ----------
    f : callable
        From an array of shape (n, d) to one of shape (n,) or (n, ...).
    domain : domain or None
        What maps uniform points into the domain of `f`; None for the unit cube.
    on_nonfinite : {"raise", "skip-and-count"}
        What to do about values that are no numbers.
    """

    def __init__(self, f: Callable[[Any], Any], domain: Any, on_nonfinite: str) -> None:
        if not callable(f):
            raise TypeError(f"f must be a function of blocks of points, not {type(f).__name__}")
        if domain is not None:
            check_domain("domain", domain)
        if on_nonfinite not in _REACTIONS:
            raise ValueError(f"on_nonfinite must be one of {', '.join(_REACTIONS)}, not {on_nonfinite!r}")
        self._f = f
        self._domain = domain
        self._skips = on_nonfinite == "skip-and-count"
        self.volume = 1.0 if domain is None else float(domain.volume)
        self.skipped = 0

    def __call__(self, u: Array, start: int, replicates: int = 1) -> tuple[Array, NDArray[np.bool_] | None]:
        """Values at uniform points, times the domain's volume, and which of them are finite (None: all).

        The points are rows from number `start` on, of one replicate after the other.
        """
        x = u if self._domain is None else self._domain.map(u)
        values = _as_values(self._f(x), len(u))
        rows: NDArray[np.bool_] = np.logical_and.reduce(np.isfinite(values).reshape(len(u), -1), axis=1)
        if rows.all():
            return values * self.volume if self.volume != 1.0 else values, None
        if not self._skips:
            first = int(np.argmin(rows))
            replicate, row = divmod(first, len(rows) // replicates)
            place = f"point {start + row}" + (f" of replicate {replicate}" if replicates > 1 else "")
            raise ValueError(
                f"f is {values[first].tolist()} at x = {np.asarray(x)[first].tolist()} ({place}); "
                "on_nonfinite='skip-and-count' leaves such points out"
            )
        self.skipped += int(len(rows) - rows.sum())
        keep = rows.reshape(-1, *[1] * (values.ndim - 1))
        return np.where(keep, values, 0.0) * self.volume, rows


def rows_per_block(d: int, replicates: int = 1) -> int:
    """How many rows of each replicate to evaluate at once."""
    return max(1, _MOST_NUMBERS // (max(d, 1) * replicates))


def _as_values(returned: Any, rows: int) -> Array:
    values = np.asarray(returned)
    if np.iscomplexobj(values):
        raise TypeError("f must be real; integrate real and imaginary part as two entries of an array")
    if values.ndim == 0 or len(values) != rows:
        raise ValueError(f"f must return an array of shape ({rows}, ...) for {rows} points, not {values.shape}")
    try:
        return values.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise TypeError(f"f must return numbers, not {values.dtype}") from None
