"""Sorts of states, which put like next to like. One sort, one file."""

from . import batch, coordinate, hilbert, split
from .sort import Sort

__all__ = ["SORTS", "Sort"]

SORTS: dict[str, Sort] = {
    "coordinate": coordinate.SORT,
    "hilbert": hilbert.SORT,
    "batch": batch.SORT,
    "split": split.SORT,
}
"""The sorts by their names."""
