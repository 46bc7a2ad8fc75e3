"""Smoothing: the hidden states given all observations, those that came later included."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np

from evenlight.arguments import SeedLike, integer
from evenlight.estimate import Estimate, from_moments
from evenlight.moments import Moments
from evenlight.smc.arguments import particle_filter
from evenlight.smc.smoothers import SMOOTHERS, History
from evenlight.smc.state_space import Array, Proposal, StateSpaceModel

__all__ = ["smooth"]


def smooth(
    model: StateSpaceModel,
    observations: Any,
    *,
    method: str = "backward",
    trajectories: SupportsIndex = 256,
    lag: SupportsIndex = 10,
    particles: SupportsIndex = 1024,
    points: Any = None,
    proposal: Proposal | None = None,
    resampling: str | None = None,
    threshold: float = 0.5,
    function: Callable[[Array], Any] | None = None,
    replicates: SupportsIndex = 8,
    seed: SeedLike = None,
) -> Estimate:
    """Estimate the mean of each state given all observations.

    Parameters
    ----------
    model, observations
        As for `filter`; for "backward" the model must have `log_move`.
    method : {"backward", "fixed_lag", "genealogy"}
        "backward": trajectories drawn from the last time to the first. "fixed_lag": from the observations up to `lag`
        times later. "genealogy": from the ancestors of the last particles, for short series.
    trajectories : int
        How many "backward" draws in each replicate, at least 1.
    lag : int
        For "fixed_lag", at least 0 (which is filtering).
    particles, points, proposal, resampling, threshold, function, replicates, seed
        As for `filter`.

    Returns
    -------
    Estimate
        Means over replicates and their standard errors, shape (T, k). The bias of a replicate is of order 1 /
        particles, and that of "fixed_lag" does not vanish.

    Raises
    ------
    TypeError, ValueError, NotImplementedError
        If an argument or what the model returns is not as above.

    Notes
    -----
    Cost per time besides filtering: particles times trajectories for "backward", particles times `lag` for "fixed_lag".
    Memory for all particles of all times.

    Examples
    --------
    >>> from evenlight import smc
    >>> y = [0.4, 0.9, -0.2, -0.5, 0.1]
    >>> model = smc.LinearGaussian(0.9, 1.0, 1.0, 1.0)
    >>> smoothed = smc.smooth(model, y, particles=256, trajectories=64, seed=2)
    >>> bool((abs(smoothed.value - smc.kalman(model, y).smoothing_means) < 5 * smoothed.standard_error).all())
    True
    """
    if method not in SMOOTHERS:
        raise ValueError(f"unknown method {method!r}; known: {', '.join(SMOOTHERS)}")
    run = particle_filter(
        model,
        observations,
        proposal,
        particles=particles,
        points=points,
        resampling=resampling,
        threshold=threshold,
        seed=seed,
    )
    draws, width = integer("trajectories", trajectories, 1), integer("lag", lag, 0)
    count = integer("replicates", replicates, 1)
    means = []
    for r in range(count):
        history = History(run, r, list(run.generations(r)), draws, width)
        means.append(_means(method, history, function))
    total = run.particles * len(run.observations)
    return from_moments(
        ((total, Moments.of(np.array(means))),),
        method=f"smoothing_{method}",
        cost=count * total,
        diagnostics={"points": (f"{type(run.points).__name__} of seed {run.seed}",)},
    )


def _means(method: str, history: History, function: Callable[[Array], Any] | None) -> Array:
    """Weighted means at all times in order."""
    found = {}
    for t, states, weights in SMOOTHERS[method](history):
        found[t] = weights @ np.asarray(states if function is None else function(states), np.float64)
    return np.array([found[t] for t in range(len(found))])
