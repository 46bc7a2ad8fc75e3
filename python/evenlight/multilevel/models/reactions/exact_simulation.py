"""Exact simulation, one reaction at a time; alone, and coupled with tau-leaping so that a sum over levels has no bias.

All paths of a block step together, each at its own time; those at the end are left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .network import Array, ReactionNetwork
from .streams import Streams

__all__ = ["coupled_exactly", "exactly"]

_TOGETHER = 64  # rounds whose numbers are drawn at once, and after which finished paths are left out


def exactly(network: ReactionNetwork, streams: Streams, n: int, horizon: float) -> tuple[Array, Array]:
    """Counts of n paths at the end, shape (S, n), and how many reactions each took, shape (n,).

    The direct method: D. T. Gillespie, J. Comput. Phys. 22(4), 403-434 (1976).
    """
    counts, _, events = _simulated(network, streams, n, 0, horizon)
    return counts, events


def coupled_exactly(
    network: ReactionNetwork, streams: Streams, n: int, steps: int, horizon: float
) -> tuple[Array, Array, Array]:
    """Counts of n pairs of paths at the end, exact and by tau-leaping in so many steps, and the reactions of each.

    Reactions are split as in `coupled_leaps`. Reference: Anderson and Higham (2012), section 6; see
    `gene_transcription`.
    """
    return _simulated(network, streams, n, steps, horizon)


class _Pairs:
    """The paths that are still on their way: exact counts, counts and frozen rates of the leaping partner, times."""

    def __init__(self, network: ReactionNetwork, n: int) -> None:
        self.rows: NDArray[np.intp] = np.arange(n)
        self.exact = network.beginning(n)
        self.leaping = network.beginning(n)
        self.frozen = network.propensities(self.leaping)
        self.time = np.zeros(n)
        self.cell: NDArray[np.int64] = np.zeros(n, np.int64)
        self.events = np.zeros(n)

    def keep(self, going: NDArray[np.bool_]) -> None:
        """Leave the others out."""
        for name in ("rows", "exact", "leaping", "frozen", "time", "cell", "events"):
            setattr(self, name, getattr(self, name)[..., going])


def _simulated(
    network: ReactionNetwork, streams: Streams, n: int, steps: int, horizon: float
) -> tuple[Array, Array, Array]:
    """With 0 steps there is no partner."""
    exact, leaping, events = network.beginning(n), network.beginning(n), np.zeros(n)
    pairs = _Pairs(network, n)
    first = 0
    while len(pairs.rows):
        u = streams.uniforms(first, 2 * _TOGETHER, pairs.rows)
        first += 2 * _TOGETHER
        np.log(u[0::2], out=u[0::2])
        for k in range(_TOGETHER):
            _advance(network, pairs, u[2 * k], u[2 * k + 1], (steps, horizon))
        done = pairs.time >= horizon
        if done.any():
            rows = pairs.rows[done]
            exact[:, rows], leaping[:, rows] = pairs.exact[:, done], pairs.leaping[:, done]
            events[rows] = pairs.events[done]
            pairs.keep(~done)
    return exact, np.maximum(leaping, 0.0), events


def _advance(network: ReactionNetwork, pairs: _Pairs, waits: Array, places: Array, grid: tuple[int, float]) -> None:
    """To the next reaction of every pair, or to the partner's next grid point if that comes first.

    Rates are constant up to either, and waiting times have no memory. A time at the horizon stays there.
    """
    steps, horizon = grid
    rates = network.propensities(pairs.exact)
    larger = np.maximum(rates, pairs.frozen) if steps else rates
    sums = np.add.accumulate(larger, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        time = pairs.time - waits / sums[-1]
    stop = np.minimum((pairs.cell + 1) * (horizon / steps), horizon) if steps else horizon
    happens = time < stop
    pairs.time = np.where(happens, time, stop)
    pairs.events += happens
    place = places * sums[-1]
    which = (place >= sums[:-1]).sum(axis=0)
    moves = network.changes.T[:, which] * happens
    if not steps:
        pairs.exact += moves
        return
    columns = np.arange(len(which))
    own, partner = rates[which, columns], pairs.frozen[which, columns]
    both = place - (sums[which, columns] - larger[which, columns]) < np.minimum(own, partner)
    pairs.exact += moves * (both | (own > partner))
    pairs.leaping += moves * (both | (own <= partner))
    reached = np.flatnonzero(~happens & (pairs.time < horizon))
    if len(reached):
        np.maximum(pairs.leaping, 0.0, out=pairs.leaping, where=~happens)
        pairs.cell[reached] += 1
        pairs.frozen[:, reached] = network.propensities(pairs.leaping[:, reached])
