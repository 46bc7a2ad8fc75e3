"""By genealogy: the past of the particles that survived. Free, but few of them have different ancestors long ago.

G. Kitagawa, "Monte Carlo filter and smoother for non-Gaussian nonlinear state space models", J. Comput. Graph. Stat.
5(1), 1-25 (1996).
"""

from __future__ import annotations

from .history import History, Smoothed, lineage

__all__ = ["smoothed"]


def smoothed(history: History) -> Smoothed:
    """One walk back from the last time."""
    generations = history.generations
    weights = generations[-1].weights
    for t, places in lineage(generations, len(generations) - 1, 0):
        yield t, generations[t].states.take(places, axis=0), weights
