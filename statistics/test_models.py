"""Models under their methods: errors against tolerances, costs; EVENLIGHT_RUNS=400 is the full size."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
import pytest
from scipy import stats

from evenlight.multilevel import debias, mlmc, mlqmc, models
from evenlight.multilevel.models import build

RUNS = int(os.environ.get("EVENLIGHT_RUNS", "100"))


def birth_and_death() -> models.ReactionPaths:
    """The mean at time 1 of arrivals at rate 40 and departures at rate 1 each, from 10."""
    network = models.ReactionNetwork([[1], [-1]], lambda x: (40.0, x[0]), [10], name="birth and death")
    return models.ReactionPaths(network, first_steps=2)


INFORMATION, WORTH = models.partial_information(0.2)
PROBLEMS: dict[str, tuple[Any, float, float]] = {
    "european": (build("gbm", "european"), 10.4505835722, 0.1),
    "european euler": (build("gbm", "european", "euler"), 10.4505835722, 0.2),
    "asian": (build("gbm", "asian", "exact", first_steps=2), 5.76309, 0.1),
    "lookback": (build("gbm", "lookback"), 17.2168022374, 0.15),
    "barrier": (build("gbm", "barrier"), 9.9492703086, 0.15),
    "digital": (build("gbm", "digital"), 53.2324815454, 0.05),
    "heston": (build("heston"), 0.1045967166, 0.002),
    "clark_cameron": (build("clark_cameron"), 1.0 / math.sqrt(math.cosh(1.0)), 0.01),
    "birth and death": (birth_and_death(), 40.0 - 30.0 * math.exp(-1.0), 0.3),
    "information": (INFORMATION, WORTH, 0.02),
}


@pytest.mark.filterwarnings("ignore::evenlight.multilevel.MultilevelWarning")  # kurtosis of few samples
@pytest.mark.parametrize("problem", PROBLEMS)
def test_errors_are_those_asked_for(problem: str) -> None:
    """Error over tolerance between 0.5 and 1.05, give or take 4 standard errors of it (7 % of it each)."""
    model, exact, tolerance = PROBLEMS[problem]
    runs = [mlmc(model, rmse=tolerance, seed=seed) for seed in range(RUNS)]
    squares = np.array([(run.value - exact) ** 2 for run in runs]) / tolerance**2
    ratio, slack = math.sqrt(squares.mean()), 4 * stats.sem(squares) / 2
    inside = np.mean([run.confidence_interval(0.95).low <= exact <= run.confidence_interval(0.95).high for run in runs])
    print(f"{problem}: error / tolerance {ratio:.3f}, inside {inside:.3f}")
    assert 0.5 - slack <= ratio <= 1.05 + slack
    assert inside >= 0.95 - 4 * math.sqrt(0.05 * 0.95 / RUNS)


@pytest.mark.filterwarnings("ignore::evenlight.multilevel.MultilevelWarning")  # kurtosis of few samples
def test_gene_transcription_to_a_quarter_of_a_percent() -> None:
    """Leaping alone, and up to the exact chain: 3714.13 ± 0.24 within 4 standard errors, bias aside."""
    leaping = mlmc(models.ReactionPaths(), rmse=8.0, seed=1)
    assert abs(leaping.value - 3714.13) <= 4 * leaping.standard_error + leaping.bias + 1.0
    exact = mlmc(models.ReactionPaths(exact_level=3), rmse=10.0, seed=2)
    assert abs(exact.value - 3714.13) <= 4 * math.hypot(exact.standard_error, 0.24)
    print("leaping", leaping, "up to the exact chain", exact)


def test_prices_without_bias() -> None:
    """Single terms and coupled sums of Milstein's European call, 10^6 values each: 4 standard errors, 1 in 16,000."""
    model = build("gbm")
    for method in ("single", "coupled"):
        estimate = debias(model, n=10**6, method=method, seed=3)
        assert abs(estimate.value - 10.4505835722) <= 4 * estimate.standard_error


def test_evenly_spread_points_take_a_tenth_of_the_cost() -> None:
    """The smooth Asian option at 10^-4 of its size: the cost of multilevel Monte Carlo is known from its variances."""
    tolerance = 2e-3
    model = build("gbm", "asian", "exact", first_steps=2, construction="pca")
    spread = mlqmc(model, rmse=tolerance, seed=1)
    independent = mlmc(build("gbm", "asian", "exact", first_steps=2), rmse=10 * tolerance, seed=1)
    gain = 100 * independent.cost / spread.cost
    print(f"multilevel quasi-Monte Carlo takes {gain:.0f} times less at {tolerance}")
    assert abs(spread.value - 5.76309) <= 4 * tolerance
    assert gain >= 10


def test_one_level_alone_costs_the_cube() -> None:
    """Euler's scheme with as much bias as noise: errors fall as cost^(-1/3), and the fit errs by 0.015."""
    model = build("gbm", "european", "euler")
    costs, errors = [], []
    for level in range(4):
        n, rng = 3700 * 4**level, np.random.default_rng(level)
        squares = [(_mean(model, level, rng.random((n, model.dims(level)))) - 10.4505835722) ** 2 for _ in range(RUNS)]
        costs.append(n * 2**level)
        errors.append(math.sqrt(np.mean(squares)))
    slope = np.polyfit(np.log(costs), np.log(errors), 1)[0]
    print(f"error falls as cost^{slope:.3f}")
    assert slope == pytest.approx(-1 / 3, abs=0.03)


def _mean(model: Any, level: int, u: Any) -> float:
    return float(model.sample(level, u).fine.mean())


@pytest.mark.filterwarnings("ignore::evenlight.multilevel.MultilevelWarning")
def test_many_levels_cost_the_square() -> None:
    """Squared tolerance times cost: constant with Milstein's scheme, at most a squared logarithm with Euler's."""
    tolerances = np.array([0.2, 0.1, 0.05, 0.025])
    # (log 0.025 / log 0.2)² is 5.3, but the first level is most of the cost of either
    for scheme, most in (("milstein", 1.5), ("euler", 2.6)):
        model = build("gbm", "european", scheme)
        costs = [np.mean([mlmc(model, rmse=float(t), seed=seed).cost for seed in range(10)]) for t in tolerances]
        scaled = np.array(costs) * tolerances**2
        print(scheme, "squared tolerance times cost:", scaled.round(0))
        assert scaled[-1] / scaled[0] < most
