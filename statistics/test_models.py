"""Models besides options, and those of two directions: errors against tolerances; EVENLIGHT_RUNS=400: full size."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
import pytest
from scipy import stats

from evenlight.multilevel import mlmc, models, multi_index
from evenlight.multilevel.models import build
from evenlight.multilevel.models.fields import UniformField

RUNS = int(os.environ.get("EVENLIGHT_RUNS", "100"))


def birth_and_death() -> models.ReactionPaths:
    """The mean at time 1 of arrivals at rate 40 and departures at rate 1 each, from 10."""
    network = models.ReactionNetwork([[1], [-1]], lambda x: (40.0, x[0]), [10], name="birth and death")
    return models.ReactionPaths(network, first_steps=2)


def call_of_eight_euler_steps() -> float:
    """The price under 8 Euler steps of 1/8 at rate .05 and volatility .2, from 100 to 100: backwards, step by step."""
    z = np.linspace(-8.0, 8.0, 1601)
    weights = stats.norm.pdf(z) * (z[1] - z[0])
    factors = 1.0 + 0.05 / 8 + 0.2 * math.sqrt(1 / 8) * z
    spots = np.linspace(0.0, 500.0, 2501)
    values = np.maximum(spots - 100.0, 0.0)
    for _ in range(8):
        values = np.array([weights @ np.interp(spot * factors, spots, values) for spot in spots])
    return math.exp(-0.05) * float(np.interp(100.0, spots, values))


INFORMATION, WORTH = models.partial_information(0.2)
PROBLEMS: dict[str, tuple[Any, float, float]] = {
    "asian": (build("gbm", "asian", "exact", first_steps=2), 5.76309, 0.1),
    "heston": (build("heston"), 0.1045967166, 0.002),
    "clark_cameron": (build("clark_cameron"), 1.0 / math.sqrt(math.cosh(1.0)), 0.01),
    "birth and death": (birth_and_death(), 40.0 - 30.0 * math.exp(-1.0), 0.3),
    "information": (INFORMATION, WORTH, 0.02),
    "gene transcription": (models.ReactionPaths(), 3714.13, 30.0),
    "mixed precision": (build("mixed_precision"), call_of_eight_euler_steps(), 0.1),
    "diffusion_1d uniform": (build("diffusion_1d", "uniform"), 0.0856394728, 0.0005),
    "diffusion_1d log_normal": (build("diffusion_1d"), 0.1075405, 0.002),
    "diffusion_2d": (build("diffusion_2d", UniformField(2)), 0.03595396, 0.0005),
}
# Of log-normal fields: the closed solution by Gauss-Legendre quadrature at 8 x 2^14 Sobol' points, to 6e-6. Meshes of
# 4 cells do not see the later terms: the mean at (1, 3) is three times those of both of its predecessors.
INDEXED: dict[str, tuple[Any, float, float]] = {
    "log_normal": (models.IndexedDiffusion1D("log_normal"), 0.1075405, 0.005),
    "log_normal, finer": (models.IndexedDiffusion1D("log_normal"), 0.1075405, 0.001),
    "uniform": (models.IndexedDiffusion1D("uniform"), 0.0856394728, 0.0005),
    "coarse mesh": (models.IndexedDiffusion1D("log_normal", first_cells=4), 0.1075405, 0.005),
    "coarse mesh, finer": (models.IndexedDiffusion1D("log_normal", first_cells=4), 0.1075405, 0.002),
    "many terms": (models.IndexedDiffusion1D(models.LogNormalField(32), first_cells=4), 0.1112464, 0.005),
    "rough field": (models.IndexedDiffusion1D(models.LogNormalField(16, length=0.1), first_cells=4), 0.1108259, 0.002),
    "two axes": (models.IndexedDiffusion2D(UniformField(2)), 0.03595396, 0.0003),
}


@pytest.mark.filterwarnings("ignore::evenlight.multilevel.MultilevelWarning")  # kurtosis of few samples
@pytest.mark.parametrize("problem", PROBLEMS)
def test_errors_are_those_asked_for(problem: str) -> None:
    judge(mlmc, problem, *PROBLEMS[problem])


@pytest.mark.filterwarnings("ignore::evenlight.multilevel.MultilevelWarning")  # kurtosis of few samples
@pytest.mark.parametrize("problem", INDEXED)
def test_errors_of_two_directions_are_those_asked_for(problem: str) -> None:
    judge(multi_index, problem, *INDEXED[problem])


def judge(method: Any, problem: str, model: Any, exact: float, tolerance: float) -> None:
    """Error over tolerance between 0.5 and 1.05, give or take 4 standard errors, which are 7 % of it each."""
    runs = [method(model, rmse=tolerance, seed=seed) for seed in range(RUNS)]
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
