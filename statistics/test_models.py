"""Models besides options under mlmc: errors against tolerances; EVENLIGHT_RUNS=400 is the full size."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
import pytest
from scipy import stats

from evenlight.multilevel import mlmc, models
from evenlight.multilevel.models import build

RUNS = int(os.environ.get("EVENLIGHT_RUNS", "100"))


def birth_and_death() -> models.ReactionPaths:
    """The mean at time 1 of arrivals at rate 40 and departures at rate 1 each, from 10."""
    network = models.ReactionNetwork([[1], [-1]], lambda x: (40.0, x[0]), [10], name="birth and death")
    return models.ReactionPaths(network, first_steps=2)


INFORMATION, WORTH = models.partial_information(0.2)
PROBLEMS: dict[str, tuple[Any, float, float]] = {
    "asian": (build("gbm", "asian", "exact", first_steps=2), 5.76309, 0.1),
    "heston": (build("heston"), 0.1045967166, 0.002),
    "clark_cameron": (build("clark_cameron"), 1.0 / math.sqrt(math.cosh(1.0)), 0.01),
    "birth and death": (birth_and_death(), 40.0 - 30.0 * math.exp(-1.0), 0.3),
    "information": (INFORMATION, WORTH, 0.02),
}


@pytest.mark.filterwarnings("ignore::evenlight.multilevel.MultilevelWarning")  # kurtosis of few samples
@pytest.mark.parametrize("problem", PROBLEMS)
def test_errors_are_those_asked_for(problem: str) -> None:
    """Error over tolerance between 0.5 and 1.05, give or take 4 standard errors, which are 7 % of it each."""
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
