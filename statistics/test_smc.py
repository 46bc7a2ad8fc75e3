"""Particles over many runs: intervals of likelihoods, and how much evenly spread points gain in 1 to 4 dimensions."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

from evenlight import smc
from evenlight.points import Sobol

RUNS = 200


def case(d: int, steps: int, noise: float) -> tuple[smc.LinearGaussian, Any, float]:
    """Coordinates that pull each other, what was observed, and the logarithm of its likelihood."""
    places = np.arange(d)
    transition = 0.4 ** (1 + np.abs(places[:, None] - places))
    model = smc.LinearGaussian(transition, np.eye(d), np.eye(d), noise**2 * np.eye(d))
    generator = np.random.default_rng(d)
    x, seen = np.zeros(d), []
    for _ in range(steps):
        x = transition @ x + generator.normal(size=d)
        seen.append(x + noise * generator.normal(size=d))
    return model, np.array(seen), smc.kalman(model, np.array(seen)).log_likelihood


@pytest.mark.parametrize("points", [None, Sobol])
def test_intervals_hold_the_likelihood(points: Any) -> None:
    """200 intervals of 8 replicates each, said to hold 95 %; 3 standard errors of 1.5 % below, once in 700 runs."""
    model, y, truth = case(1, 20, 0.5)
    held = 0
    for seed in range(RUNS):
        low, high = smc.filter(model, y, particles=512, points=points, seed=seed).confidence_interval(0.95)
        held += low <= truth <= high
    print("coverage:", held / RUNS)
    assert held / RUNS >= 0.95 - 3 * np.sqrt(0.95 * 0.05 / RUNS)


@pytest.mark.parametrize(("d", "noise", "runs", "least"), [(1, 0.5, 400, 20.0), (2, 0.7, 40, 8.0), (4, 1.0, 40, 1.5)])
def test_gain_of_evenly_spread_points(d: int, noise: float, runs: int, least: float) -> None:
    """Mean squared errors of log Z. With kurtosis 5, as in one dimension, their ratio has a relative error of 13 %.

    There 20 is three such errors below the 35 that were measured: other rounding makes other runs.
    """
    model, y, truth = case(d, 30, noise)
    errors = [
        smc.filter(model, y, particles=4096, points=points, replicates=runs, seed=5).diagnostics["replicates"] - truth
        for points in (None, Sobol)
    ]
    gain = np.mean(errors[0] ** 2) / np.mean(errors[1] ** 2)
    print("gain:", gain, "of", d, "dimensions")
    assert gain > least
    ratios = np.exp(errors[1])
    assert abs(ratios.mean() - 1) < 4.5 * stats.sem(ratios)
