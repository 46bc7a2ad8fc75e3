"""Figures, by matplotlib, which only they need."""

from __future__ import annotations

from typing import Any

__all__ = ["empty_figure"]


def empty_figure(width: float, height: float) -> Any:
    """Return an empty `matplotlib.figure.Figure` of a size in inches; an ImportError says what is missing."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        raise ImportError("figures need matplotlib: pip install 'evenlight[plots]'") from None

    return Figure(figsize=(width, height), layout="constrained")
