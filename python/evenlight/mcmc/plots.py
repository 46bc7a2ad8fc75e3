"""Trace and rank plots: records of what they show, and figures from them (which need matplotlib)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from evenlight.arguments import integer
from evenlight.figures import empty_figure

from .chains import Chains, values_at
from .kernel import Array

__all__ = ["RankRecord", "TraceRecord", "rank_figure", "rank_record", "trace_figure", "trace_record"]

_MOST_NAMED = 8  # chains


@dataclass(frozen=True, eq=False)
class TraceRecord:
    """Where chains were.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import TraceRecord, trace_figure
    >>> len(trace_figure(TraceRecord(np.arange(3), np.zeros((4, 3, 2)))).axes)
    2
    """

    steps: NDArray[np.int64]
    """Numbers of the steps shown."""
    values: Array
    """Shape (chains, steps shown, k): of k quantities, the d coordinates or values of a function."""
    names: Sequence[str] = ()
    """Of the quantities; numbers by default."""


@dataclass(frozen=True, eq=False)
class RankRecord:
    """How the ranks of each chain's draws, among those of all chains, are spread: evenly if the chains agree.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import RankRecord, rank_figure
    >>> len(rank_figure(RankRecord(np.full((4, 10, 2), 50.0), expected=50.0)).axes)
    2
    """

    counts: Array
    """Shape (chains, bins, k)."""
    expected: float
    """The count if all is well."""
    names: Sequence[str] = ()
    """Of the k quantities; numbers by default."""


def trace_record(
    chains: Chains, most: SupportsIndex = 2000, functional: Callable[[Any], Any] | None = None
) -> TraceRecord:
    """What a trace plot shows: every so many-th step.

    Parameters
    ----------
    chains : Chains
        With draws.
    most : int
        The most steps to show.
    functional : callable, optional
        From positions (m, d) to values (m,) or (m, k), shown in place of the positions.

    Returns
    -------
    TraceRecord
        Plain arrays.

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, run, trace_record
    >>> chains = run(RandomWalk(lambda x: -abs(x[:, 0])), [0.0], n=5000, chains=2)
    >>> trace_record(chains, most=1000).values.shape
    (2, 1000, 1)
    """
    draws = chains.kept_draws()
    steps = np.arange(0, draws.shape[1], -(-draws.shape[1] // integer("most", most, 1)))
    return TraceRecord(steps, *_shown(draws[:, steps], functional))


def rank_record(chains: Chains, bins: SupportsIndex = 20, functional: Callable[[Any], Any] | None = None) -> RankRecord:
    """What a rank plot shows (A. Vehtari et al. 2021): a histogram of ranks for each chain.

    Parameters
    ----------
    chains : Chains
        With draws.
    bins : int
        At least 2.
    functional : callable, optional
        From positions (m, d) to values (m,) or (m, k), ranked in place of the positions.

    Returns
    -------
    RankRecord
        Plain arrays.

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, rank_record, run
    >>> chains = run(RandomWalk(lambda x: -abs(x[:, 0])), [0.0], n=500, chains=4)
    >>> record = rank_record(chains, bins=10)
    >>> record.counts.shape, record.expected
    ((4, 10, 1), 50.0)
    """
    count = integer("bins", bins, 2)
    values, names = _shown(chains.kept_draws(), functional)
    number, n, k = values.shape
    ranks = stats.rankdata(values.reshape(-1, k), axis=0, method="average").reshape(values.shape)
    places = np.minimum(((ranks - 0.5) / (number * n) * count).astype(np.int64), count - 1)
    counts = np.stack([(places == place).sum(axis=1) for place in range(count)], axis=1)
    return RankRecord(counts.astype(np.float64), n / count, names)


def trace_figure(record: TraceRecord) -> Any:
    """One panel for each quantity, one line for each chain.

    Parameters
    ----------
    record : TraceRecord
        From `trace_record`.

    Returns
    -------
    matplotlib.figure.Figure
        To be saved with `savefig`.

    Raises
    ------
    ImportError
        If matplotlib is not installed.

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, run, trace_figure, trace_record
    >>> chains = run(RandomWalk(lambda x: -(x**2).sum(axis=1)), [0.0, 0.0], n=100, chains=4)
    >>> len(trace_figure(trace_record(chains)).axes)
    2
    """
    figure, panels = _panels(record.values.shape[2])
    for j, panel in enumerate(panels):
        panel.plot(record.steps, record.values[:, :, j].T, linewidth=0.6, alpha=0.7)
        panel.set_ylabel(_name(record.names, j))
    panels[-1].set_xlabel("step")
    _legend(panels[0], len(record.values))
    return figure


def rank_figure(record: RankRecord) -> Any:
    """One panel for each quantity, one histogram for each chain; level ones are good.

    Parameters
    ----------
    record : RankRecord
        From `rank_record`.

    Returns
    -------
    matplotlib.figure.Figure
        To be saved with `savefig`.

    Raises
    ------
    ImportError
        If matplotlib is not installed.

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, rank_figure, rank_record, run
    >>> chains = run(RandomWalk(lambda x: -(x**2).sum(axis=1)), [0.0, 0.0], n=100, chains=4)
    >>> len(rank_figure(rank_record(chains)).axes)
    2
    """
    figure, panels = _panels(record.counts.shape[2])
    edges = np.linspace(0, 1, record.counts.shape[1] + 1)
    for j, panel in enumerate(panels):
        for counts in record.counts[:, :, j]:
            panel.stairs(counts, edges, alpha=0.7)
        panel.axhline(record.expected, color="black", linewidth=0.6, linestyle="--")
        panel.set_ylabel(f"draws of {_name(record.names, j)}")
    panels[-1].set_xlabel("rank among all chains")
    _legend(panels[0], len(record.counts))
    return figure


def _shown(draws: Array, functional: Callable[[Any], Any] | None) -> tuple[Array, list[str]]:
    """Values (chains, n, k) and their names."""
    values = draws if functional is None else values_at(functional, draws)
    values = values.reshape(*values.shape[:2], -1)
    symbol = "x" if functional is None else "f"
    return values, [f"{symbol}[{j}]" for j in range(values.shape[2])]


def _name(names: Sequence[str], j: int) -> str:
    return names[j] if names else str(j)


def _legend(panel: Any, chains: int) -> None:
    """Which color is which chain, where they can be told apart."""
    if chains <= _MOST_NAMED:
        lines = [line for line in (*panel.lines, *panel.patches) if line.get_linestyle() != "--"]
        names = [f"chain {i}" for i in range(chains)]
        above = {"loc": "lower left", "bbox_to_anchor": (0, 1), "frameon": False}
        panel.legend(lines[:chains], names, ncols=chains, fontsize=8, **above)


def _panels(count: int) -> tuple[Any, list[Any]]:
    figure = empty_figure(8, 1 + 1.8 * count)
    return figure, list(figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0])
