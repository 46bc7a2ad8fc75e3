"""Primary sample space: its steps against their law, and integrals from accepted and rejected proposals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from evenlight.mcmc import Antithetic, PrimarySampleSpace, RandomWalk, expected_value_integral, run


def ridge(u: Any) -> Any:
    """The target of the first coordinate, a narrow ridge on a low floor."""
    return np.exp(-200 * (u[:, 0] - 0.3) ** 2) + 0.05


def log_ridge(u: Any) -> Any:
    return np.log(ridge(u))


def exact_bins(edges: np.ndarray) -> np.ndarray:
    """The ridge's integrals between edges."""
    return np.diff((np.pi / 200) ** 0.5 * special.ndtr(20 * (edges - 0.3)) + 0.05 * edges)


EDGES = np.linspace(0, 1, 11)
BINS = exact_bins(EDGES)


def shares(u: Any) -> Any:
    """In which of ten bins a point is."""
    return (np.floor(u[:, :1] * 10) == np.arange(10)).astype(float)


def radiance(u: Any) -> Any:
    return ridge(u)[:, None] * shares(u)


def small_steps(rows: int) -> np.ndarray:
    """Signed small steps from 1/2, which never wrap."""
    kernel = PrimarySampleSpace(lambda u: np.zeros(len(u)), large_step=1e-300)
    state = kernel.init(np.full((rows, 1), 0.5))
    _, info = kernel.step(state, np.random.default_rng(1).uniform(size=(rows, 3)))
    return np.asarray(info.proposal[:, 0] - 0.5)


def test_small_steps_are_symmetric_and_of_log_uniform_size() -> None:
    """Chi-square of both signs in 20 bins and Kolmogorov-Smirnov of sizes: false alarms in 10,000 each."""
    steps = small_steps(100_000)
    sizes = np.log(np.abs(steps) * 1024) / np.log(16)
    table = [np.histogram(sizes[steps * sign > 0], bins=20, range=(0, 1))[0] for sign in (1, -1)]
    assert stats.chi2_contingency(table).pvalue > 1e-4
    assert stats.kstest(sizes, "uniform").pvalue > 1e-4
    mean = (1 / 64 - 1 / 1024) / np.log(16)
    assert mean == pytest.approx(0.0052833, abs=5e-8)
    assert abs(np.abs(steps).mean() - mean) < 4 * np.abs(steps).std() / 100_000**0.5


def test_small_steps_wrap_and_never_reach_one() -> None:
    kernel = PrimarySampleSpace(lambda u: np.zeros(len(u)), large_step=1e-300, smallest=0.25, largest=0.25)
    state = kernel.init(np.array([[0.1], [0.9], [0.25]]))
    after, _ = kernel.step(state, np.array([[0.2, 0.5, 0.5], [0.7, 0.5, 0.5], [0.2, 0.5, 0.5]]))
    np.testing.assert_allclose(after.position[:, 0], [0.85, 0.15, 0.0], atol=1e-15)
    tiny = kernel.init(np.array([[np.nextafter(0.25, 0)]]))  # 2^-54 less than the step
    assert kernel.step(tiny, np.array([[0.2, 0.5, 0.5]]))[0].position[0, 0] < 1


CHAINS = run(PrimarySampleSpace(log_ridge), [0.3], n=8000, chains=64, burn_in=100, seed=3)


def test_histograms_of_chains_are_those_of_the_target() -> None:
    """Ten bins within 2 %, which is at least 4 standard errors: a false alarm in 1,500."""
    exact = BINS / BINS.sum()
    kernel = PrimarySampleSpace(log_ridge, large_step=0.5)
    estimate = run(kernel, [0.3], n=8000, chains=1024, burn_in=100, seed=3).estimate(shares)
    assert (estimate.standard_error < 0.005 * exact).all()
    assert (np.abs(estimate.value / exact - 1) < 0.02).all()


@pytest.mark.parametrize("total", [None, float(BINS.sum())])
def test_expected_values_give_integrals(total: float | None) -> None:
    """Ten bins within 5 standard errors, Student's t of 63: a false alarm in 20,000 each."""
    estimate = expected_value_integral(CHAINS, radiance, total=total)
    assert (np.abs(estimate.value - BINS) < 5 * estimate.standard_error).all()
    assert (estimate.standard_error < 0.02 * BINS).all()
    assert (estimate.replicates, estimate.degrees_of_freedom) == (64, 63)


def test_expected_values_vary_less_than_counts_in_dark_bins() -> None:
    """Variances over 64 chains, where counts know the exact total: the mean logarithm of seven ratios, all near 3."""
    dark = BINS < 0.02
    counts = BINS.sum() * CHAINS.estimate(shares).standard_error
    for total in (None, float(BINS.sum())):
        error = expected_value_integral(CHAINS, radiance, total=total).standard_error
        assert np.exp(np.log((counts / error) ** 2)[dark].mean()) > 2


@pytest.mark.parametrize(
    "kernel, settings, message",
    [
        (RandomWalk(log_ridge), {}, "must be of the kernel primary_sample_space"),
        (PrimarySampleSpace(log_ridge), {"points": Antithetic()}, "couples chains"),
        (PrimarySampleSpace(log_ridge, large_step=1e-9), {}, "no large step of chain 0"),
    ],
)
def test_expected_values_refuse_what_they_cannot_use(kernel: Any, settings: Any, message: str) -> None:
    chains = run(kernel, [0.3], n=10, chains=4, seed=1, **settings)
    with pytest.raises(ValueError, match=message):
        expected_value_integral(chains, radiance)
