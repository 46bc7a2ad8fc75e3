"""Integrands judged: Sobol' indices, effective dimensions and variations with known values."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.stats import sobol_indices as scipy_indices
from scipy.stats import uniform

from evenlight import points, quality

Array = npt.NDArray[np.float64]


def ishigami(x: Array) -> Array:
    """T. Ishigami and T. Homma 1990, with a = 7 and b = 0.1."""
    angle = np.pi * (2 * x - 1)
    found: Array = np.sin(angle[:, 0]) + 7 * np.sin(angle[:, 1]) ** 2 + 0.1 * angle[:, 2] ** 4 * np.sin(angle[:, 0])
    return found


def exact_ishigami() -> tuple[Array, Array, float]:
    """Indices of first and total order and the variance, in closed form."""
    a, b, pi = 7, 0.1, math.pi
    first = (1 + b * pi**4 / 5) ** 2 / 2
    second = a**2 / 8
    mixed = b**2 * pi**8 * 8 / 225
    variance = first + second + mixed
    return np.array([first, second, 0]) / variance, np.array([first + mixed, second, mixed]) / variance, variance


def test_sobol_indices_are_exact_within_their_errors_and_agree_with_scipy() -> None:
    first, total, variance = exact_ishigami()
    found = quality.sobol_indices(ishigami, 3, n=2048, replicates=16, seed=3)
    # six comparisons with Student's t of 15 degrees of freedom: beyond 5.5 in 3 of 10,000 runs; and a floor of rounding
    assert (np.abs(found.first_order - first) < 5.5 * found.first_order_error + 1e-12).all()
    assert (np.abs(found.total_order - total) < 5.5 * found.total_order_error + 1e-12).all()
    assert found.first_order_error.max() < 0.003
    assert found.total_order_error.max() < 0.003
    assert found.mean == pytest.approx(3.5, abs=1e-2)
    assert found.variance == pytest.approx(variance, rel=1e-2)
    coordinates: list[Any] = [uniform()] * 3
    theirs = scipy_indices(func=lambda x: ishigami(x.T), n=4096, dists=coordinates, rng=np.random.default_rng(1))
    assert found.first_order == pytest.approx(theirs.first_order, abs=0.02)
    assert found.total_order == pytest.approx(theirs.total_order, abs=0.02)


def test_errors_of_sobol_indices_are_those_that_are_made() -> None:
    first, _, _ = exact_ishigami()
    runs = [quality.sobol_indices(ishigami, 3, n=64, replicates=8, seed=seed) for seed in range(60)]
    scores = np.concatenate([(run.first_order - first) / run.first_order_error for run in runs])
    # Student's t with 7 degrees of freedom is within 2.36 in 95 % of all cases; 180 of them, not all independent
    assert 0.88 < (np.abs(scores) < 2.365).mean() <= 1
    assert 0.5 < np.sqrt((scores**2).mean()) < 1.8


def test_effective_dimensions_of_products_are_known() -> None:
    weights = np.array([1.0, 0.5, 0.25, 0.1])

    def product(x: Array) -> Array:
        found: Array = np.prod(1 + weights * np.sqrt(12) * (x - 0.5), axis=1)
        return found

    parts = weights**2
    total = np.prod(1 + parts) - 1
    first = np.cumprod(1 + parts) - 1
    polynomial = np.array([1.0])
    for part in parts:
        polynomial = np.convolve(polynomial, [1.0, part])
    found = quality.effective_dimension(product, 4, n=2048, seed=5)
    # eight comparisons with Student's t of 15 degrees of freedom
    assert (np.abs(found.first.value - first / total) < 5.5 * found.first.standard_error + 1e-12).all()
    assert (np.abs(found.orders.value - polynomial[1:] / total) < 5.5 * found.orders.standard_error + 1e-12).all()
    mean = (polynomial[1:] @ np.arange(1, 5)) / total
    assert abs(found.mean_dimension - mean) < 5.5 * found.mean_dimension_error
    assert (found.truncation, found.superposition) == (
        1 + int(np.argmax(first / total >= 0.99)),
        1 + int(np.argmax(np.cumsum(polynomial[1:]) / total >= 0.99)),
    )


def test_variations_are_known() -> None:
    exponential = lambda x: np.exp(x.sum(axis=1))  # noqa: E731
    for d in (1, 2, 3):
        # every mixed derivative is f: the sum over faces of (e − 1)^|u| e^(d − |u|)
        wanted = sum(math.comb(d, k) * (math.e - 1) ** k * math.e ** (d - k) for k in range(1, d + 1))
        grid = quality.hardy_krause_variation(exponential, d, size=8)
        assert grid.value == pytest.approx(wanted, rel=1e-12)
        assert grid.kind == "lower"
        smooth = quality.hardy_krause_variation(None, d, size=64, derivative=lambda x, u: np.exp(x.sum(axis=1)))
        assert smooth.value == pytest.approx(wanted, rel=1e-4)
        assert smooth.kind == "quadrature"
    wave = quality.hardy_krause_variation(lambda x: np.cos(2 * np.pi * x[:, 0]), 2, size=100)
    assert wave.vitali == {(0,): pytest.approx(4), (1,): 0, (0, 1): 0}
    finer = [
        quality.hardy_krause_variation(lambda x: np.sin(9 * x[:, 0] * x[:, 1]), 2, size=s).value for s in (4, 16, 64)
    ]
    assert finer == sorted(finer)


def test_the_koksma_hlawka_bound_holds() -> None:
    variation = quality.hardy_krause_variation(lambda x: np.exp(x.sum(axis=1)), 2)
    for n in (10, 100, 1000):
        x = points.Halton(2, seed=n).points(0, n)
        error = abs(np.exp(x.sum(axis=1)).mean() - (math.e - 1) ** 2)
        bound = quality.koksma_hlawka_bound(variation, quality.star_discrepancy(x))
        assert error <= bound
    lower = quality.star_discrepancy(points.Halton(3).points(0, 50), "threshold_accepting")
    with pytest.raises(ValueError, match="a lower bound of the discrepancy bounds no error"):
        quality.koksma_hlawka_bound(1.0, lower)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: quality.sobol_indices(lambda x: x, 2), r"f must return shape \(1024,\) for 1024 points"),
        (lambda: quality.sobol_indices(lambda x: np.log(x[:, 0] - 2), 2), "f is not finite at"),
        (lambda: quality.sobol_indices(lambda x: np.ones(len(x)), 2), "f is constant"),
        (lambda: quality.sobol_indices(lambda x: x[:, 0], 2, replicates=1), "replicates must be at least 2, not 1"),
        (lambda: quality.effective_dimension(lambda x: x[:, 0], 13), "d must be at most 12, not 13"),
        (lambda: quality.effective_dimension(lambda x: x[:, 0], 2, share=1), r"share must be in \(0, 1\), not 1"),
        (lambda: quality.hardy_krause_variation(None, 2), "give either f or derivative"),
        (lambda: quality.hardy_krause_variation(lambda x: x[:, 0], 9), "more than 2.24 points"),
    ],
)
def test_what_has_no_meaning_is_refused(call: Any, message: str) -> None:
    with np.errstate(invalid="ignore"), pytest.raises(ValueError, match=message):
        call()


def test_what_is_no_function_is_named() -> None:
    with pytest.raises(TypeError, match="f must be a function, not int"):
        quality.sobol_indices(3, 2)  # type: ignore[arg-type]
