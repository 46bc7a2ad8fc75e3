"""Tau-leaping: all reactions of a time step at once, with rates as at its start; alone, and coupled on two grids.

Biased: rates are frozen within a step, and counts that would become negative are 0. A step costs the same however many
reactions it has.
"""

from __future__ import annotations

import numpy as np

from .network import Array, ReactionNetwork
from .poisson import poisson
from .streams import Streams

__all__ = ["coupled_leaps", "leaps"]


def leaps(network: ReactionNetwork, streams: Streams, n: int, steps: int, horizon: float) -> Array:
    """Counts of n paths at the end, shape (S, n); number j of step k of a stream belongs to reaction j.

    Reference: D. T. Gillespie, J. Chem. Phys. 115(4), 1716-1733 (2001).
    """
    x = network.beginning(n)
    h = horizon / steps
    for k in range(steps):
        u = streams.uniforms(k * network.reactions, network.reactions)
        events = poisson(u, h * network.propensities(x))
        x += network.changes.T @ events
        np.maximum(x, 0.0, out=x)
    return x


def coupled_leaps(
    network: ReactionNetwork, streams: Streams, n: int, steps: tuple[int, int], horizon: float
) -> tuple[Array, Array]:
    """Counts of n pairs of paths at the end, on a fine and a coarse grid of so many steps.

    Every reaction is split: at the smaller of the two rates it happens in both paths, at the difference in the one with
    the larger rate. Each path on its own is one of `leaps`.

    Reference: Anderson and Higham (2012), section 5; see `gene_transcription`.
    """
    steps_fine, steps_coarse = steps
    ratio = steps_fine // steps_coarse
    h = horizon / steps_fine
    fine, coarse = network.beginning(n), network.beginning(n)
    rates_coarse = network.propensities(coarse)
    size = network.reactions
    for k in range(steps_fine):
        if k % ratio == 0:
            np.maximum(coarse, 0.0, out=coarse)
            rates_coarse = network.propensities(coarse)
        rates = network.propensities(fine)
        shared = np.minimum(rates, rates_coarse)
        rates -= rates_coarse
        u = streams.uniforms(2 * k * size, 2 * size)
        both = poisson(u[:size], h * shared)
        one = poisson(u[size:], h * np.abs(rates))
        ahead = rates > 0.0
        fine += network.changes.T @ (both + one * ahead)
        coarse += network.changes.T @ (both + one * ~ahead)
        np.maximum(fine, 0.0, out=fine)
    return fine, np.maximum(coarse, 0.0, out=coarse)
