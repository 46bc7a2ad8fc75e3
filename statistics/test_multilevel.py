"""Longer tests of multilevel methods: promised errors on options, exponents of cost, no bias in 10^7 values."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import pytest
from scipy import special

from evenlight.estimate import Estimate
from evenlight.multilevel import (
    LevelDistribution,
    MultilevelWarning,
    debias,
    mlmc,
    mlqmc,
)
from evenlight.multilevel.models import GeometricBrownianMotion
from evenlight.points import Independent
from option_prices import PRICES
from toy_levels import ExponentialSeries


def quietly(driver: Any, *arguments: Any, **settings: Any) -> Estimate:
    """A run without warnings of heavy tails, which some of these payoffs have."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MultilevelWarning)
        estimate: Estimate = driver(*arguments, **settings)
    return estimate


# Of 100 runs, the root mean squared error has a standard error of 7 % of itself. Digital options by conditional
# expectations have larger errors at 0.3 than at 0.5, where the pilot, which waits for rare differences, is enough.
@pytest.mark.parametrize(
    ("payoff", "scheme", "rmse"),
    [
        ("european", "milstein", 0.2),
        ("european", "milstein", 0.1),
        ("asian", "milstein", 0.1),
        ("lookback", "milstein", 0.1),
        ("barrier", "milstein", 0.1),
        ("digital", "milstein", 0.3),
        ("digital", "milstein", 0.1),
        ("european", "euler", 0.2),
        ("european", "euler", 0.1),
        ("asian", "euler", 0.1),
        ("lookback", "euler", 0.2),
        ("digital", "euler", 0.5),
    ],
)
def test_errors_are_as_promised(payoff: str, scheme: str, rmse: float) -> None:
    ratio, covered = promised(payoff, scheme, rmse)
    assert 0.5 < ratio < 1.05
    assert covered >= 0.88  # 95 % promised: 3.2 standard errors


# Means of their differences are 0.124, -0.013, -0.044, -0.057, -0.063, -0.052, ...: at first they look as if they had
# converged, later their noise is as large as the bias. This misses the promise; what is tested is by how much.
@pytest.mark.parametrize("rmse", [0.5, 0.2, 0.1])
def test_barriers_looked_at_only_at_time_steps_exceed_tolerances_by_less_than_two(rmse: float) -> None:
    assert 0.5 < promised("barrier", "euler", rmse)[0] < 1.9


def promised(payoff: str, scheme: str, rmse: float) -> tuple[float, float]:
    """Root mean squared error of 100 runs over the tolerance, and the share of intervals that hold the price."""
    model = GeometricBrownianMotion(payoff, scheme)
    found = [quietly(mlmc, model, rmse=rmse, seed=seed) for seed in range(100)]
    errors = np.array([estimate.value - PRICES[payoff] for estimate in found])
    intervals = np.array([estimate.confidence_interval(0.95) for estimate in found])
    ratio = math.sqrt(np.mean(errors**2)) / rmse
    covered = np.mean((intervals[:, 0] < PRICES[payoff]) & (PRICES[payoff] < intervals[:, 1]))
    print(f"{payoff} {scheme} {rmse}: RMSE / tolerance {ratio:.2f}, coverage {covered:.2f}")
    return ratio, float(covered)


def test_one_level_has_the_exponent_one_third() -> None:
    # n ∝ 4^l paths of 2^l Euler steps: bias and noise both halve from level to level at 8 times the cost
    model = GeometricBrownianMotion("european", "euler")
    levels, runs = np.arange(1, 5), (400, 400, 200, 60)
    errors = []
    for level, count in zip(levels.tolist(), runs, strict=True):
        n, points = 10_000 * 4 ** (level - 1), Independent(model.dims(level), seed=level)
        blocks = (points.points(run * n, (run + 1) * n) for run in range(count))
        means = np.array([model.sample(level, u).fine.mean() for u in blocks])
        errors.append(math.sqrt(np.mean((means - PRICES["european"]) ** 2)))
    slope = np.polyfit(3 * levels * math.log(2), np.log(errors), 1, w=np.sqrt(runs))[0]
    assert abs(slope + 1 / 3) < 0.03  # standard error 0.012


def test_costs_of_many_levels_grow_as_the_theorem_says() -> None:
    tolerances = np.array([0.2, 0.1, 0.05, 0.025])
    products = {}
    for scheme in ("milstein", "euler"):
        model = GeometricBrownianMotion("european", scheme)
        costs = [np.mean([quietly(mlmc, model, rmse=e, seed=s).cost for s in range(12)]) for e in tolerances]
        products[scheme] = np.array(costs) * tolerances**2
    assert products["milstein"].max() / products["milstein"].min() < 1.4  # constant
    logarithms = (np.log(tolerances[-1] / 10) / np.log(tolerances[0] / 10)) ** 2  # of the tolerance over the price
    assert 1.0 < products["euler"][-1] / products["euler"][0] < logarithms


def test_evenly_spread_points_save_ten_times_on_the_smooth_asian_option() -> None:
    even = GeometricBrownianMotion("asian", "exact", construction="pca")
    estimate = mlqmc(even, rmse=1e-3, seed=1)
    assert abs(estimate.value - PRICES["asian"]) < 4e-3
    independent = mlmc(GeometricBrownianMotion("asian", "exact"), rmse=1e-2, seed=1).cost * 100  # costs go as ε^-2
    assert estimate.cost * 10 < independent


@pytest.mark.parametrize(
    ("method", "square"),
    [("single", 2.0 * special.i0(2.0 * math.sqrt(2.0))), ("coupled", 11.5869773565), ("independent", 11.5869773565)],
)
def test_ten_million_values_of_a_series_have_no_bias(method: str, square: float) -> None:
    estimate = debias(
        ExponentialSeries(), n=10**7, method=method, distribution=LevelDistribution.geometric(1.0), seed=3
    )
    assert abs(estimate.value - math.e) < 3 * math.sqrt((square - math.e**2) / 1e7)
    assert estimate.standard_error**2 * 1e7 == pytest.approx(square - math.e**2, rel=0.01)


def test_ten_million_values_of_an_option_have_no_bias() -> None:
    # the variance is known from an independent calculation; fine and coarse steps: 1.5 E 2^N - P(N = 0) / 2
    model = GeometricBrownianMotion("european", "milstein")
    estimate = debias(model, n=10**7, distribution=LevelDistribution.geometric(1.5), seed=1)
    assert abs(estimate.value - PRICES["european"]) < 3 * estimate.standard_error
    assert estimate.standard_error**2 * 1e7 == pytest.approx(356.0, rel=0.05)
    assert estimate.cost / 1e7 == pytest.approx(1.5 * 2.207 - 0.5 * 0.646, rel=0.01)


def test_ten_million_coupled_values_of_an_option_have_no_bias() -> None:
    model = GeometricBrownianMotion("european", "milstein")
    estimate = debias(model, n=10**7, method="coupled", distribution=LevelDistribution.geometric(1.5), seed=2)
    assert abs(estimate.value - PRICES["european"]) < 3 * estimate.standard_error
    assert estimate.standard_error < 0.01


def test_the_best_random_level_needs_less_than_a_geometric_one() -> None:
    model = GeometricBrownianMotion("european", "milstein")
    works = [
        estimate.standard_error**2 * estimate.cost
        for estimate in (
            debias(model, n=10**6, seed=1),
            debias(model, n=10**6, seed=1, method="independent"),
            debias(model, n=10**6, distribution=LevelDistribution.geometric(1.5), seed=1),
        )
    ]
    assert max(works[:2]) < works[2]
