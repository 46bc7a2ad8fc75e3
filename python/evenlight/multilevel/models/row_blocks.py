"""Rows in blocks: what models work on at once, so that the arrays of a block stay in a cache."""

from __future__ import annotations

from collections.abc import Iterator

__all__ = ["row_blocks"]

_NUMBERS = 2**15  # what a second-level cache holds with room for the rest


def row_blocks(n: int, columns: int, *, numbers: int = _NUMBERS, least: int = 64) -> Iterator[slice]:
    """Slices that cover n rows of so many columns: `numbers` in each, but at least `least` rows.

    A block has its overhead, in particular where its rows are worked on step by step: that is what `least` is for.
    """
    rows = max(numbers // columns, least)
    return (slice(start, min(start + rows, n)) for start in range(0, n, rows))
