"""Smoothers against the Kalman smoother, and what is particular about each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from conftest import ROOT
from evenlight import smc
from evenlight.points import Sobol


def series(steps: int, seed: int = 1) -> tuple[smc.LinearGaussian, Any]:
    """A walk of two coordinates, seen with noise."""
    model = smc.LinearGaussian([[0.8, 0.1], [0.1, 0.6]], np.eye(2), np.eye(2), np.eye(2))
    generator = np.random.default_rng(seed)
    x, seen = np.zeros(2), []
    for _ in range(steps):
        x = model.transition @ x + generator.normal(size=2)
        seen.append(x + generator.normal(size=2))
    return model, np.array(seen)


def test_no_smoother_is_forgotten() -> None:
    files = {path.stem for path in (ROOT / "python/evenlight/smc/smoothers").glob("*.py")} - {"__init__", "history"}
    assert files == set(smc.SMOOTHERS)


@pytest.mark.parametrize("method", smc.SMOOTHERS)
@pytest.mark.parametrize("points", [None, Sobol])
def test_every_smoother_agrees_with_the_exact_one(method: str, points: Any) -> None:
    """24 numbers of 20 replicates, Student's t of 19 below 5.5 and 5e-3 for a bias of order 1 / n: once in 10³ runs."""
    model, y = series(12)
    exact = smc.kalman(model, y).smoothing_means
    smoothed = smc.smooth(
        model, y, method=method, lag=12, particles=512, trajectories=64, points=points, replicates=20, seed=3
    )
    assert smoothed.value.shape == (12, 2)
    assert (np.abs(smoothed.value - exact) < 5.5 * np.hypot(smoothed.standard_error, 5e-3)).all()
    assert np.max(smoothed.standard_error) < 0.1


def test_a_lag_of_nothing_is_filtering_and_a_long_one_is_genealogy() -> None:
    model, y = series(8)
    settings: dict[str, Any] = {"particles": 256, "replicates": 3, "seed": 2}
    filtered = smc.filter(model, y, **settings).diagnostics["filtering_means"]
    assert np.allclose(smc.smooth(model, y, method="fixed_lag", lag=0, **settings).value, filtered, atol=1e-13)
    long = smc.smooth(model, y, method="fixed_lag", lag=7, **settings)
    assert np.allclose(long.value, smc.smooth(model, y, method="genealogy", **settings).value, atol=1e-13)


def test_ancestors_run_out_where_backward_sampling_does_not() -> None:
    """60 times back, the error of genealogies is several times larger; F(19, 19) exceeds 5.5 twice in 10⁴."""
    model, y = series(60)
    exact = smc.kalman(model, y).smoothing_means[0]
    errors = {}
    for method in ("genealogy", "backward"):
        smoothed = smc.smooth(
            model, y, method=method, particles=128, trajectories=64, threshold=1.0, replicates=20, seed=4
        )
        errors[method] = 20 * np.sum(smoothed.standard_error[0] ** 2)
        assert np.abs(smoothed.value[0] - exact).max() < 5 * np.max(smoothed.standard_error[0])
    print(errors)
    assert errors["genealogy"] > 5.5 * errors["backward"]


def test_any_function_of_the_states_is_smoothed() -> None:
    model, y = series(6)
    exact = smc.kalman(model, y)
    smoothed = smc.smooth(
        model, y, particles=256, trajectories=64, function=lambda x: x[:, 0] * x[:, 1], replicates=20, seed=5
    )
    product = exact.smoothing_means[:, 0] * exact.smoothing_means[:, 1] + exact.smoothing_covariances[:, 0, 1]
    assert (np.abs(smoothed.value - product) < 5.5 * np.hypot(smoothed.standard_error, 2e-2)).all()


class WithoutDensity(smc.StochasticVolatility):
    """As users write models that only filter."""

    log_move = smc.StateSpaceModel.log_move


def test_refusals_and_bits() -> None:
    model, y = series(4)
    runs = [smc.smooth(model, y, particles=64, replicates=2, seed=seed) for seed in (1, 1, 2)]
    assert (runs[0].value == runs[1].value).all()
    assert not (runs[0].value == runs[2].value).any()
    with pytest.raises(ValueError, match="unknown method 'rts'; known: backward"):
        smc.smooth(model, y, method="rts")
    with pytest.raises(ValueError, match="trajectories"):
        smc.smooth(model, y, trajectories=0)
    with pytest.raises(NotImplementedError, match="WithoutDensity has no log_move"):
        smc.smooth(WithoutDensity(), [0.1, 0.2])
