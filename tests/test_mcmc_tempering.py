"""Parallel tempering: swaps and barriers of normals, exactly; ladders that space themselves; round trips."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from evenlight.mcmc import (
    HMC,
    Ladder,
    MetropolisHastings,
    ParallelTempering,
    Proposal,
    RandomWalk,
    run,
    tempering_ladder,
)
from evenlight.mcmc.ladder import respaced

D = 4


def normal(x: Any) -> Any:
    return -0.5 * (x**2).sum(axis=1)


def exact_draws(log_density: Any, beta: float) -> MetropolisHastings:
    """Forgets where it was: a power of a normal is a wider normal."""
    scale = beta**-0.5
    proposal = Proposal(D, lambda x, u: scale * special.ndtri(u), lambda y, x: -0.5 * beta * (y**2).sum(axis=1))
    return MetropolisHastings(log_density, proposal)


def exact_rejections(betas: Any) -> Any:
    """Energies are gamma variables: a swap's probability is 2 P(F > ratio), F with (d, d) degrees of freedom."""
    return 1 - 2 * stats.f.sf(np.asarray(betas)[:-1] / np.asarray(betas)[1:], D, D)


def exact_barrier(hottest: float) -> float:
    """Half of the mean distance of two gamma variables, over all inverse temperatures."""
    return float(special.poch(D / 2, 0.5) / math.pi**0.5 * math.log(1 / hottest))


def walk(log_density: Any, beta: float) -> RandomWalk:
    return RandomWalk(log_density, scale=2 / beta**0.5)


def test_rejections_and_round_trips_are_the_exact_ones() -> None:
    """Within 5 standard errors: 0.004 of rates, 1.6 % of about 1,350 round trips."""
    betas = [1.0, 0.6, 0.2, 0.1]
    kernel = ParallelTempering(normal, exact_draws, betas)
    ladder = tempering_ladder(run(kernel, np.zeros(D), n=400, chains=32, burn_in=200, seed=1))
    np.testing.assert_allclose(ladder.rejections, exact_rejections(betas), atol=0.02)
    assert ladder.barrier == pytest.approx(exact_rejections(betas).sum(), abs=0.03)
    assert ladder.steps == 12_800
    assert ladder.round_trip_rate == pytest.approx(ladder.best_round_trip_rate, rel=0.08)


def test_many_levels_measure_the_barrier() -> None:
    """What no spacing changes: 40 levels come within 1 % of the limit, whether even or not."""
    even = np.geomspace(1, 0.01, 40)
    assert exact_rejections(even).sum() == pytest.approx(exact_barrier(0.01), rel=0.003)
    kernel = ParallelTempering(normal, exact_draws, even.tolist())
    ladder = tempering_ladder(run(kernel, np.zeros(D), n=60, chains=32, burn_in=2, seed=2))
    assert ladder.barrier == pytest.approx(exact_barrier(0.01), rel=0.02)
    assert ladder.suggested_levels == 1 + math.ceil(2 * ladder.barrier)


def test_a_warm_up_makes_a_bad_ladder_even() -> None:
    """For normals a geometric ladder is even: temperatures within 10 %, from steps in equal differences."""
    kernel = ParallelTempering(normal, walk, np.linspace(1, 0.01, 6).tolist(), levels=6)
    assert np.ptp(exact_rejections(kernel.inverse_temperatures)) > 0.5
    chains = run(kernel, np.zeros(D), n=100, chains=16, warm_up=1600, seed=3)
    np.testing.assert_allclose(chains.kernel.inverse_temperatures, np.geomspace(1, 0.01, 6), rtol=0.1)
    fixed = ParallelTempering(normal, walk, [1.0, 0.5, 0.1])
    assert run(fixed, np.zeros(D), n=10, warm_up=100).kernel is fixed


def test_neighbors_of_far_modes_come_to_reject_alike() -> None:
    """Modes 24 deviations apart, weights 1 and 3: rates within 0.05 of each other, whose own errors are below 0.01."""

    def modes(x: Any) -> Any:
        at = x[:, 0]
        return np.logaddexp(-0.5 * (at - 12) ** 2, np.log(3) - 0.5 * (at + 12) ** 2) - 0.5 * x[:, 1] ** 2

    start = np.linspace(1, 0.005, 6).tolist()
    fixed = ParallelTempering(modes, walk, start)
    before = tempering_ladder(run(fixed, [12.0, 0.0], n=600, chains=32, seed=4))
    kernel = ParallelTempering(modes, walk, start, levels=6)
    chains = run(kernel, [12.0, 0.0], n=1500, chains=32, warm_up=1600, seed=4)
    ladder = tempering_ladder(chains)
    assert np.ptp(before.rejections) > 0.5
    assert np.ptp(ladder.rejections) < 0.05
    assert 0 < ladder.round_trip_rate <= ladder.best_round_trip_rate
    estimate = chains.estimate(lambda x: x[:, 0] > 0)
    assert abs(estimate.value - 0.25) < 4.5 * estimate.standard_error < 0.1


def test_spacing_inverts_a_known_barrier() -> None:
    """Rejections of a barrier that grows as the square of log beta: evenly spaced square roots."""
    logs = np.linspace(0, 3, 31)
    found = -np.log(respaced(np.exp(-logs), np.diff(logs**2)))
    np.testing.assert_allclose(found, np.sqrt(np.linspace(0, 9, 31)), atol=0.01)
    none = respaced(np.geomspace(1, 0.1, 5), np.zeros(4))
    np.testing.assert_allclose(none, np.geomspace(1, 0.1, 5))


def test_states_hold_the_target_itself_at_all_temperatures() -> None:
    """So that a ladder may change under them; here HMC, whose state has gradients too."""
    kernel = ParallelTempering(normal, lambda f, beta: HMC(f, lambda x: -beta * x, step_size=0.5, steps=4), levels=3)
    chains = run(kernel, np.ones(D), n=5, warm_up=200, seed=5)
    assert chains.kernel.inverse_temperatures != kernel.inverse_temperatures
    for level in chains.state.levels:
        np.testing.assert_allclose(level.log_density, normal(level.position))
        np.testing.assert_allclose(level.gradient, -level.position)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: ParallelTempering(normal, walk, levels=1), "levels must be at least 2"),
        (lambda: ParallelTempering(normal, walk, [1, 0.5], levels=3), "2 inverse_temperatures for 3 levels"),
        (lambda: ParallelTempering(normal, walk, hottest=1.0), "hottest must be above 0 and below 1"),
        (lambda: tempering_ladder(run(RandomWalk(normal), [0.0], n=5)), "chains of ParallelTempering"),
    ],
)
def test_ladders_that_cannot_be_are_refused(call: Any, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        call()


def test_the_best_ladder_rejects_half() -> None:
    """Twice the barrier in pairs, which each reject a half: round trips as in the closed form."""
    ladder = Ladder(np.geomspace(1, 0.1, 7), np.full(6, 0.5), 10, 100)
    assert (ladder.barrier, ladder.suggested_levels, ladder.round_trip_rate) == (3.0, 7, 0.1)
    assert ladder.best_round_trip_rate == pytest.approx(1 / (2 + 2 * 6))
