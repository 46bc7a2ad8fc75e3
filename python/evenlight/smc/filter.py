"""Particle filters: the likelihood of a state-space model and the states it hides. With `points`, sequential QMC."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np

from evenlight.arguments import SeedLike, integer
from evenlight.moments import Moments
from evenlight.smc.arguments import particle_filter
from evenlight.smc.log_evidence import LogEvidence, log_evidence
from evenlight.smc.particle_filter import ParticleFilter
from evenlight.smc.state_space import Array, Proposal, StateSpaceModel
from evenlight.smc.weights import effective_size

__all__ = ["filter"]


def filter(
    model: StateSpaceModel,
    observations: Any,
    *,
    particles: SupportsIndex = 1024,
    points: Any = None,
    proposal: Proposal | None = None,
    resampling: str | None = None,
    threshold: float = 0.5,
    function: Callable[[Array], Any] | None = None,
    replicates: SupportsIndex = 8,
    seed: SeedLike = None,
) -> LogEvidence:
    """Estimate the likelihood of observations, and the mean of each state given the observations so far.

    Parameters
    ----------
    model : StateSpaceModel
        Such as `StochasticVolatility()`, or one of your own.
    observations : sequence of length T
        What `log_observation` takes as y, from time 0 on.
    particles : int
        In each replicate, at least 2; powers of 2 for Sobol' points.
    points : evenlight.points.Engine or its class, optional
        Drives the particles with a randomized sequence without end, such as ``Sobol``: sequential quasi-Monte Carlo.
        Its dimensions are the model's and its seed follows from `seed`. Random numbers by default.
    proposal : Proposal, optional
        Moves particles in the model's place, and weights make up for it: a guided filter.
    resampling : {"systematic", "stratified", "residual", "multinomial"}, optional
        How particles are selected by their weights; by default "systematic", and "stratified" with `points`, where it
        has less error for smooth models (measured: a quarter of the mean square for stochastic volatility).
    threshold : float
        Without `points`, resample when the weights are worth less than this share of the particles (1 / Σ w²); 1 is
        always.
    function : callable, optional
        From states, shape (n, dims), to what is averaged, shape (n,) or (n, k); the states themselves by default.
    replicates : int
        Independent runs, whose spread is the error; at least 1 (without an error).
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.

    Returns
    -------
    LogEvidence
        The logarithm of the likelihood Z of all observations. Each replicate is unbiased for Z, not for log Z.
        Diagnostics: "replicates" (the logarithms, shape (R,)), "filtering_means" and "filtering_standard_errors" (shape
        (T, k)), and "effective_sizes" (1 / Σ w², the mean over replicates, shape (T,)).

    Raises
    ------
    TypeError, ValueError
        If an argument or what the model returns is not as above, or all weights are zero at some time.

    Notes
    -----
    Cost per particle and time: the model's and about 50 nanoseconds, in several dimensions the Hilbert sort besides.
    With `points` the particles are sorted, by value or along Hilbert's curve, and point i moves what number i of the
    resampling scheme selects. The error falls faster than n^(-1/2) then; measured for 4,096 particles, the mean squared
    error of log Z is hundreds to thousands of times smaller in one dimension, ten to thirty in two, three to four in
    four.

    References: N. J. Gordon, D. J. Salmond and A. F. M. Smith, IEE Proc. F 140(2), 107-113 (1993); M. Gerber and N.
    Chopin, "Sequential quasi Monte Carlo", J. R. Stat. Soc. B 77(3), 509-579 (2015).

    Examples
    --------
    >>> from evenlight import smc
    >>> from evenlight.points import Sobol
    >>> y = [0.4, 0.9, -0.2, -0.5, 0.1]
    >>> model = smc.LinearGaussian(0.9, 1.0, 1.0, 0.04)
    >>> random = smc.filter(model, y, particles=1024, seed=1)
    >>> even = smc.filter(model, y, particles=1024, points=Sobol, seed=1)
    >>> even.standard_error < random.standard_error / 4
    True
    >>> abs(even.value - smc.kalman(model, y).log_likelihood) < 5 * even.standard_error
    True
    """
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
    count = integer("replicates", replicates, 1)
    of_states = (lambda states: states) if function is None else function
    logarithms, means, sizes = zip(*(_run(run, r, of_states) for r in range(count)), strict=True)
    moments = Moments.of(np.array(means))
    total = count * run.particles * len(run.observations)
    return log_evidence(
        logarithms,
        n=total,
        cost=total,
        method="smc" if points is None else "sqmc",
        points=(f"{type(run.points).__name__} of seed {run.seed}",),
        filtering_means=moments.mean,
        filtering_standard_errors=moments.standard_error,
        effective_sizes=np.mean(sizes, axis=0),
    )


def _run(run: ParticleFilter, replicate: int, function: Callable[[Array], Any]) -> tuple[float, Array, Array]:
    """The logarithm of Z, weighted means, and effective sizes of one replicate."""
    total, means, sizes = 0.0, [], []
    for generation in run.generations(replicate):
        total += generation.log_increment
        values = np.asarray(function(generation.states), np.float64)
        if len(values) != run.particles:
            raise ValueError(f"function must return {run.particles} rows, not shape {values.shape}")
        means.append(generation.weights @ values)
        sizes.append(effective_size(generation.weights))
    return total, np.array(means), np.array(sizes)
