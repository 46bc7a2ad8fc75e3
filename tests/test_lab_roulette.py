"""Roulette as a de-biased sum: optimal survival probabilities, their predicted variance, and what they gain."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from evenlight import BounceStatistics
from evenlight.lab import optimal_survival, roulette_study


def test_no_other_survival_has_less_work() -> None:
    rng = np.random.default_rng(5)
    for _ in range(20):
        segments = int(rng.integers(2, 8))
        squares = np.cumsum(rng.exponential(0.4 ** np.arange(segments + 1)[::-1]))[::-1]  # falling, in uneven steps
        rays = np.sort(rng.uniform(0.2, 2.0, segments + 1))[::-1]
        bounces = BounceStatistics(squares, squares, squares, np.ones(segments + 1), rays)
        found = np.array(optimal_survival(bounces))
        others = rng.uniform(0.01, 1.0, (5000, segments - 1))
        survival = np.concatenate([[found[:-1]], others, np.clip(0.1 * others + 0.9 * found[:-1], 0.0, 1.0)])
        reach = np.cumprod(np.concatenate([np.ones((len(survival), 1)), survival], axis=1), axis=1)
        work = (-np.diff(squares) / reach).sum(axis=1) * (rays[:-1] * reach).sum(axis=1)
        assert work[0] <= work.min() * 1.02  # the found ones stay below 0.99, so that paths end


def test_optimal_roulette_beats_fixed_roulette(scenes: Path) -> None:
    study = roulette_study(scenes / "furnace.xml", spp=32, size=(32, 32), seed=3)
    assert set(study.others) == {"0.5", "0.75", "0.9", "throughput"}
    everything = [study.optimal, *study.others.values()]
    samples = 8 * 32 * 32 * 32
    truth = study.others["throughput"]
    for result in everything:  # unbiased: 5 standard errors, a false alarm in 2 million
        error = np.sqrt((result.variance + truth.variance) / samples)
        assert abs(result.mean - truth.mean) < 5 * error
        assert result.seconds > 0
    # as predicted: 5 standard errors of the renders' variance, and 5 % for the noise of the measured bounces
    optimal = study.optimal
    assert abs(optimal.variance - optimal.predicted_variance) < 5 * optimal.standard_error + 0.05 * optimal.variance
    for name in ("0.5", "0.75", "0.9"):  # variances are known to 1 %, gains are 1.4 and more
        other = study.others[name]
        assert other.work > 1.3 * optimal.work
        assert other.variance * other.rays > 1.3 * optimal.variance * optimal.rays


def test_studies_refuse_what_says_nothing(scenes: Path) -> None:
    one = np.ones(1)
    with pytest.raises(ValueError, match="at least 2 segments"):
        optimal_survival(BounceStatistics(one, one, one, one, one))
    two = np.array([1.0, 0.5])
    with pytest.raises(ValueError, match="squared_mean must be at least 0"):
        optimal_survival(BounceStatistics(two, two, two, two, two), squared_mean=2.0)
    with pytest.raises(ValueError, match="segments"):
        roulette_study(scenes / "box.xml", segments=2)
    with pytest.raises(ValueError, match="fixed must be probabilities"):
        roulette_study(scenes / "box.xml", fixed=[0.5, 1.0])
