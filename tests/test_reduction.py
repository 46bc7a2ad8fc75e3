"""Variance reduction: the same exact answers with less error, by as much as theory says."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy import stats

import evenlight
from evenlight import integrands
from evenlight.domains import Box, Law
from evenlight.importance import Normal
from evenlight.points import Independent, Sobol
from evenlight.reduction import Stratum, antithetic, conditional, control_variates, ratio, stratified


def exponential(x: np.ndarray) -> np.ndarray:
    return np.asarray(np.exp(x[:, 0]))


def test_antithetic_points_have_the_variance_of_theory() -> None:
    """Of (e^u + e^(1 - u)) / 2: (variance + covariance) / 2, with covariance e - (e - 1)²."""
    estimate = evenlight.integrate(antithetic(exponential), Independent(1, seed=1), n=2**16)
    variance = (math.e**2 - 1) / 2 - (math.e - 1) ** 2
    covariance = math.e - (math.e - 1) ** 2
    assert estimate.standard_error**2 * 2**16 == pytest.approx((variance + covariance) / 2, rel=0.03)
    assert abs(estimate.value - (math.e - 1)) < 4 * estimate.standard_error


def test_antithetic_points_of_a_law_mirror_it() -> None:
    odd = antithetic(lambda x: x[:, 0] ** 3 + 2, Law(Normal([0.0])))
    assert evenlight.integrate(odd, Independent(1), n=64).value == pytest.approx(2.0, rel=1e-9)


def test_conditioning_smooths_and_never_harms() -> None:
    """A ramp across an edge: with the edge's own coordinate integrated, the error is that of a smooth function."""
    f = integrands.build("genz_gaussian", 3)
    plain = evenlight.integrate(f, Independent(3, seed=1), n=2**12)
    inner = evenlight.integrate(conditional(f, 1), Independent(2, seed=1), n=2**12)
    assert abs(inner.value - f.exact) < 4 * inner.standard_error
    assert inner.standard_error < plain.standard_error
    with pytest.raises(ValueError, match="coordinate 7 is none of 3"):
        evenlight.integrate(conditional(f, 7), Independent(2), n=64)


def test_control_variates_take_out_what_they_explain() -> None:
    controls = lambda x: np.stack([x[:, 0], x[:, 0], 2 * x[:, 0] + 1], axis=1)  # noqa: E731  # of rank 1
    points = Independent(1, seed=2)
    estimate = control_variates(exponential, controls, [0.5, 0.5, 2.0], points, n=2**14)
    variance = (math.e**2 - 1) / 2 - (math.e - 1) ** 2
    explained = (3 - math.e) ** 2 * 3 / variance  # cov(u, e^u) = (3 - e) / 2, var(u) = 1 / 12
    assert estimate.diagnostics["explained"] == pytest.approx(explained, abs=2e-3)
    assert abs(estimate.value - (math.e - 1)) < 5 * estimate.standard_error


def test_control_variates_help_even_points() -> None:
    f = lambda x: np.where(x[:, 0] + x[:, 1] > 1, 1.0, 0.0) + 0.1 * x[:, 0]  # noqa: E731
    step = lambda x: np.where(x[:, 0] + x[:, 1] > 1, 1.0, 0.0)[:, np.newaxis]  # noqa: E731
    with_control = control_variates(f, step, [0.5], Sobol(2, seed=1), n=2**12)
    assert with_control.standard_error < 0.05 * evenlight.integrate(f, Sobol(2, seed=1), n=2**12).standard_error
    assert abs(with_control.value - 0.55) < 5 * with_control.standard_error


def test_ratios_cancel_common_errors() -> None:
    f = lambda x: np.exp(x[:, 0]) * x[:, 1]  # noqa: E731
    covered = []
    for seed in range(200):
        low, high = ratio(f, exponential, Independent(2, seed=seed), n=16 * 64).confidence_interval(0.95)
        covered.append(low <= 0.5 <= high)
    assert abs(np.mean(covered) - 0.95) <= 3 * np.sqrt(0.95 * 0.05 / 200)
    with pytest.raises(ValueError, match="there is no ratio"):
        ratio(f, lambda x: 0 * x[:, 0], Independent(2), n=64)


def test_strata_have_the_variance_of_theory() -> None:
    """x² on ten slices: proportional is the sum of w² var / n_j, Neyman's is (sum of w sd)² / n."""
    edges = np.linspace(0, 1, 11)
    strata = [Stratum(0.1, Box([a], [b])) for a, b in pairwise(edges)]
    mean = np.diff(edges**3) / 3 * 10
    deviation = np.sqrt(np.diff(edges**5) / 5 * 10 - mean**2)
    for allocation, variance in (
        ("proportional", np.mean(deviation**2) / 10_000),
        ("neyman", np.mean(deviation) ** 2 / 9_000),
    ):
        estimate = stratified(lambda x: x[:, 0] ** 2, strata, n=10_000, allocation=allocation)  # type: ignore[arg-type]
        assert estimate.standard_error**2 == pytest.approx(variance, rel=0.06)
        assert abs(estimate.value - 1 / 3) < 4 * estimate.standard_error


def test_strata_may_be_laws() -> None:
    """A mixture of two normals, by its components."""
    strata = [Stratum(0.25, Law(Normal([0.0]))), Stratum(0.75, Law(stats.norm(4, 1)))]
    estimate = stratified(lambda x: x[:, 0], strata, n=4000, allocation="proportional")
    assert abs(estimate.value - 3) < 4 * estimate.standard_error
    with pytest.raises(ValueError, match="4 for each"):
        stratified(lambda x: x[:, 0], strata, n=7)


def two_by_two(x: np.ndarray) -> np.ndarray:
    """e^x, x², 1 + x and 0: four values for every point, shape (m, 2, 2)."""
    u = x[:, 0]
    return np.stack([np.exp(u), u**2, 1 + u, 0 * u], axis=1).reshape(-1, 2, 2)


def entry(f: Any, row: int, column: int) -> Any:
    return lambda x: f(x)[:, row, column]


MEANS = np.array([[math.e - 1, 1 / 3], [1.5, 0.0]])


def test_arrays_of_values_are_estimated_entry_by_entry() -> None:
    """Every entry as if it were alone, bit for bit where nothing is shared; within 5 standard errors of the truth."""
    points, strata = Independent(1, seed=8), [Stratum(0.5, Box([0], [0.5])), Stratum(0.5, Box([0.5], [1]))]
    centered = lambda x: x[:, :1] - 0.5  # noqa: E731
    methods: dict[str, Any] = {
        "controls": lambda f: control_variates(f, centered, [0.0], points, n=2048),
        "ratio": lambda f: ratio(f, lambda x: 1 + x[:, 0], points, n=2048),
        "strata": lambda f: stratified(f, strata, n=2048, allocation="proportional"),
        "conditional": lambda f: evenlight.integrate(conditional(f, 0), Independent(1), n=64),
    }
    for name, method in methods.items():
        estimate = method(two_by_two)
        truth = MEANS / 1.5 if name == "ratio" else MEANS
        assert estimate.value.shape == estimate.standard_error.shape == (2, 2), name
        assert (np.abs(estimate.value - truth) <= 5 * estimate.standard_error + 1e-12).all(), name
        for row, column in np.ndindex(2, 2):
            alone = method(entry(two_by_two, row, column))
            assert estimate.value[row, column] == pytest.approx(alone.value, rel=1e-12, abs=1e-12)
            assert estimate.standard_error[row, column] == pytest.approx(alone.standard_error, rel=1e-6, abs=1e-12)


def test_strata_share_points_by_all_values() -> None:
    """One value varies in the first half only, the other in the second: both halves get points."""
    strata = [Stratum(0.5, Box([0], [0.5])), Stratum(0.5, Box([0.5], [1]))]
    f = lambda x: np.stack([np.minimum(x[:, 0], 0.5), 100 * np.maximum(x[:, 0], 0.5)], axis=1)  # noqa: E731
    estimate = stratified(f, strata, n=4000)
    np.testing.assert_allclose(estimate.value, [0.375, 62.5], rtol=0.01)
    counts = estimate.diagnostics["counts"] / estimate.n
    # deviations alike, in units of the mean sizes 0.375 and 0.625 (times 100)
    np.testing.assert_allclose(counts, np.array([1 / 0.375, 1 / 0.625]) / (1 / 0.375 + 1 / 0.625), atol=0.03)
