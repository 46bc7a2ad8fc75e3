"""By a fixed lag: each state given the observations up to so many times later. A small bias, and no loss of ancestors.

G. Kitagawa and S. Sato, "Monte Carlo smoothing and self-organising state-space model", in *Sequential Monte Carlo
Methods in Practice* (2001), section 9.2.
"""

from __future__ import annotations

from .history import History, Smoothed, lineage

__all__ = ["smoothed"]


def smoothed(history: History) -> Smoothed:
    """A short walk back for every time."""
    generations = history.generations
    for t in range(len(generations)):
        last = min(t + history.lag, len(generations) - 1)
        *_, (_, places) = lineage(generations, last, t)
        yield t, generations[t].states.take(places, axis=0), generations[last].weights
