"""Quantiles: exact answers, honest intervals, and less error with even points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

import evenlight
from evenlight.domains import Box, Law
from evenlight.importance import Normal
from evenlight.points import Independent, Sobol

P = np.array([0.01, 0.5, 0.95])


def total(x: np.ndarray) -> np.ndarray:
    return np.asarray(x.sum(axis=1))


@pytest.mark.parametrize("engine", [Independent, Sobol])
def test_intervals_hold_the_exact_quantiles(engine: Any) -> None:
    """Sums of 4 normals: 200 runs; 95 % less three standard errors, and within four of no bias at all."""
    law, exact = Law(Normal(np.zeros(4))), stats.norm(0, 2).ppf(P)
    runs = [evenlight.quantile(total, engine(4, seed=seed), P, n=2**14, domain=law) for seed in range(200)]
    covered = np.mean([(np.abs(run.value - exact) <= run.half_width(0.95)) for run in runs], axis=0)
    assert (covered >= 0.95 - 3 * np.sqrt(0.95 * 0.05 / 200)).all(), covered
    found = np.array([run.value for run in runs])
    assert (np.abs(found.mean(axis=0) - exact) < 4 * stats.sem(found, axis=0) + 16 / 2**14).all()


def test_independent_points_have_the_error_of_theory_and_even_ones_less() -> None:
    """Independent: p (1 - p) / (n density²). Even: a third of it, which 16 replicates know to 18 %."""
    law = Law(Normal(np.zeros(4)))
    plain = evenlight.quantile(total, Independent(4, seed=3), 0.5, n=2**14, domain=law, replicates=256)
    theory = 0.5 / np.sqrt(2**14) / stats.norm(0, 2).pdf(0)
    assert plain.standard_error == pytest.approx(theory, rel=0.18)  # 255 degrees of freedom: four standard errors
    even = evenlight.quantile(total, Sobol(4, seed=3), 0.5, n=2**14, domain=law)
    assert even.standard_error < 0.5 * plain.standard_error


def test_a_quantile_is_a_number_and_merges() -> None:
    runs = [evenlight.quantile(total, Sobol(1, seed=seed), 0.25, n=1600, domain=Box([0], [4])) for seed in (1, 2)]
    assert isinstance(runs[0].value, float)
    merged = runs[0].merge(runs[1])
    assert merged.value == pytest.approx(1.0, abs=0.01)
    assert merged.n == 3200


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"probability": 0.0}, "above 0 and below 1"),
        ({"probability": [0.5, 1.5]}, "above 0 and below 1"),
        ({"n": 100}, "no multiple of 16"),
        ({"f": lambda x: x}, "one number for each point"),
        ({"replicates": 1}, "replicates must be at least 2"),
    ],
)
def test_arguments_without_meaning_are_refused(arguments: dict[str, Any], message: str) -> None:
    settings: dict[str, Any] = {"f": total, "points": Sobol(2), "probability": 0.5, "n": 160} | arguments
    with pytest.raises(ValueError, match=message):
        evenlight.quantile(**settings)
