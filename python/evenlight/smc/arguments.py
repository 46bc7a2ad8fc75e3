"""What filters and smoothers are asked, checked once: model, observations, particles, points, resampling."""

from __future__ import annotations

from typing import Any, SupportsIndex

from evenlight.arguments import SeedLike, integer, seed_number
from evenlight.points import Independent
from evenlight.smc.numbers import example_points
from evenlight.smc.particle_filter import ParticleFilter
from evenlight.smc.resampling import RESAMPLING
from evenlight.smc.state_space import Proposal, StateSpaceModel

__all__ = ["particle_filter"]


def particle_filter(
    model: StateSpaceModel,
    observations: Any,
    proposal: Proposal | None,
    *,
    particles: SupportsIndex,
    points: Any,
    resampling: str | None,
    threshold: float,
    seed: SeedLike,
) -> ParticleFilter:
    """The settings of a run, or an error that names the culprit."""
    if not isinstance(model, StateSpaceModel):
        raise TypeError(f"model must be a StateSpaceModel, not {type(model).__name__}")
    if proposal is not None and not isinstance(proposal, Proposal):
        raise TypeError(f"proposal must be a Proposal, not {type(proposal).__name__}")
    if len(observations) == 0:
        raise ValueError("observations must be at least one")
    if not 0 <= threshold <= 1:
        raise ValueError(f"threshold must be from 0 to 1, not {threshold}")
    if resampling is None:
        resampling = "systematic" if points is None else "stratified"
    if resampling not in RESAMPLING:
        raise ValueError(f"unknown resampling {resampling!r}; known: {', '.join(RESAMPLING)}")
    return ParticleFilter(
        model,
        observations,
        proposal,
        integer("particles", particles, 2),
        Independent(1) if points is None else example_points(points),
        points is not None,
        resampling,
        threshold,
        seed_number(seed),
    )
