"""VEGAS through its package: exact answers, the same bits, arrays, domains; and what is said without the package."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

from evenlight.domains import Box, Law
from evenlight.importance import Normal, vegas_estimate

EXACT = (np.pi / 100) ** 1.5  # of a peak, but for 1e-12


def peak(x: np.ndarray) -> np.ndarray:
    return np.asarray(np.exp(-100 * ((x - 0.5) ** 2).sum(axis=1)))


def test_the_mean_of_runs_is_exact() -> None:
    """40 runs, their mean within 4 standard errors; the spread they state is the one they have, 1e-3 on either side."""
    runs = [vegas_estimate(peak, 3, n=20_000, seed=seed) for seed in range(40)]
    found = np.array([run.value for run in runs])
    assert abs(found.mean() - EXACT) < 4 * found.std(ddof=1) / np.sqrt(40)
    stated = np.mean([run.standard_error**2 for run in runs])
    assert 0.5 < found.var(ddof=1) / stated < 1.8
    assert all(run.degrees_of_freedom == 9 for run in runs)


@pytest.mark.parametrize("combine", ["equal", "inverse-variance"])
def test_the_seed_decides_every_bit(combine: Any) -> None:
    first, again, other = (vegas_estimate(peak, 3, n=5000, seed=seed, combine=combine) for seed in (7, 7, 8))
    assert (first.value, first.standard_error) == (again.value, again.standard_error)
    assert first.value != other.value
    merged = first.merge(other)
    assert merged.n == first.n + other.n
    assert merged.value == pytest.approx((first.value + other.value) / 2, rel=0.01)


def test_function_values_are_counted() -> None:
    seen = []

    def counted(x: np.ndarray) -> np.ndarray:
        seen.append(len(x))
        return peak(x)

    estimate = vegas_estimate(counted, 3, n=20_000)
    assert estimate.cost == sum(seen) <= 20_000
    assert 0.4 * 20_000 < estimate.n < 0.55 * 20_000
    assert vegas_estimate(peak, 3, n=20_000, learn=0).n > 15_000


@pytest.mark.parametrize("combine", ["equal", "inverse-variance"])
def test_arrays_and_domains(combine: Any) -> None:
    """Moments of a normal, and an area: within 5 standard errors, or 2 % where these claim too much."""
    moments = lambda x: np.stack([x[:, 0] ** 2, 1 + x[:, 0] * x[:, 1]], axis=1)  # noqa: E731
    law = Law(Normal([0.0, 0.0], [[2.0, 0.5], [0.5, 1.0]]))
    found = vegas_estimate(moments, law, n=20_000, combine=combine)
    assert found.value.shape == found.standard_error.shape == (2,)
    assert (np.abs(found.value - [2.0, 1.5]) < np.maximum(5 * found.standard_error, 0.04)).all()
    area = vegas_estimate(lambda x: (x**2).sum(axis=1) < 1, Box([-1, -1], [1, 1]), n=20_000, combine=combine)
    assert area.value == pytest.approx(np.pi, rel=0.02)


def test_values_that_are_no_numbers_are_named() -> None:
    with pytest.raises(ValueError, match="f is nan at x = "):
        vegas_estimate(lambda x: np.where(x[:, 0] > 0.9, np.nan, 1.0), 2, n=1000)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"learn": 1.0}, "learn must be"),
        ({"combine": "median"}, "combine must be"),
        ({"iterations": 1}, "iterations must be at least 2"),
        ({"n": 10}, "n must be at least 20"),
    ],
)
def test_arguments_without_meaning_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        vegas_estimate(peak, 3, **arguments)


def test_without_the_package_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "vegas", None)
    with pytest.raises(ImportError, match=r"pip install evenlight\[vegas\]"):
        vegas_estimate(peak, 3)
