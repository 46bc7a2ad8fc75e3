"""Smoothers: from a run of a particle filter to each state given all observations. One smoother, one file."""

from collections.abc import Callable

from . import backward, fixed_lag, genealogy
from .history import History, Smoothed

__all__ = ["SMOOTHERS", "History"]

SMOOTHERS: dict[str, Callable[[History], Smoothed]] = {
    "backward": backward.smoothed,
    "fixed_lag": fixed_lag.smoothed,
    "genealogy": genealogy.smoothed,
}
"""The smoothers by their names."""
