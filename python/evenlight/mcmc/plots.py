"""Trace and rank plots: records of what they show, and figures from them (which need matplotlib)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from evenlight.arguments import integer
from evenlight.figures import empty_figure

from .chains import Chains
from .kernel import Array

__all__ = ["RankRecord", "TraceRecord", "rank_figure", "rank_record", "trace_figure", "trace_record"]


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
    """Shape (chains, steps shown, d)."""


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
    """Shape (chains, bins, d)."""
    expected: float
    """The count if all is well."""


def trace_record(chains: Chains, most: SupportsIndex = 2000) -> TraceRecord:
    """What a trace plot shows: every so many-th step.

    Parameters
    ----------
    chains : Chains
        With draws.
    most : int
        The most steps to show.

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
    return TraceRecord(steps, draws[:, steps])


def rank_record(chains: Chains, bins: SupportsIndex = 20) -> RankRecord:
    """What a rank plot shows (A. Vehtari et al. 2021): a histogram of ranks for each chain.

    Parameters
    ----------
    chains : Chains
        With draws.
    bins : int
        At least 2.

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
    draws = chains.kept_draws()
    number, n, d = draws.shape
    ranks = stats.rankdata(draws.reshape(-1, d), axis=0, method="average").reshape(draws.shape)
    places = np.minimum(((ranks - 0.5) / (number * n) * count).astype(np.int64), count - 1)
    counts = np.stack([(places == place).sum(axis=1) for place in range(count)], axis=1)
    return RankRecord(counts.astype(np.float64), n / count)


def trace_figure(record: TraceRecord) -> Any:
    """One panel for each dimension, one line for each chain.

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
        panel.set_ylabel(f"x[{j}]")
    panels[-1].set_xlabel("step")
    return figure


def rank_figure(record: RankRecord) -> Any:
    """One panel for each dimension, one histogram for each chain; level ones are good.

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
        panel.set_ylabel(f"draws of x[{j}]")
    panels[-1].set_xlabel("rank among all chains")
    return figure


def _panels(count: int) -> tuple[Any, list[Any]]:
    figure = empty_figure(8, 1 + 1.8 * count)
    return figure, list(figure.subplots(count, 1, sharex=True, squeeze=False)[:, 0])
