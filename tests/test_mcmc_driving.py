"""Driving sequences: periods, tables, shifts; known variance reductions of Gibbs samplers."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from evenlight import mcmc, quality
from evenlight.mcmc import DRIVING, LFSR, Gibbs, IndependentNumbers, run

CASES: dict[str, Any] = {"independent": IndependentNumbers(), "lfsr": LFSR(10)}


def test_every_sequence_has_a_case_and_every_file_is_registered() -> None:
    assert set(CASES) == set(DRIVING)
    folder = Path(inspect.getfile(mcmc.driving)).parent
    assert {path.stem for path in folder.glob("*.py")} - {"__init__", "protocol"} == set(DRIVING)


@pytest.mark.parametrize("name", CASES)
def test_streams_do_not_depend_on_blocks_and_replicates_differ(name: str) -> None:
    driving = CASES[name]
    n = driving.length(3) or 100
    stream = driving.stream(3, n, 4, 7)
    whole = stream(0, n)
    assert whole.shape == (4 * driving.coupled, n, 3)
    assert ((whole >= 0) & (whole < 1)).all()
    assert (np.concatenate([stream(0, 1), stream(1, 63), stream(63, n)], axis=1) == whole).all()
    assert (driving.stream(3, n, 4, 7)(0, n) == whole).all()
    assert not (driving.stream(3, n, 4, 8)(0, n) == whole).any()
    assert len(np.unique(whole[:, 5, 1])) == len(whole)


@pytest.mark.parametrize("name", CASES)
def test_every_number_is_uniform(name: str) -> None:
    """Number 17, coordinate 1, of 2,000 replicates (Kolmogorov and Smirnov): a false alarm in 10,000."""
    driving = CASES[name]
    n = driving.length(2) or 100
    numbers = driving.stream(2, n, 2000, 3)(17, 18)[:: driving.coupled, 0, 1]
    assert stats.kstest(numbers, "uniform").pvalue > 1e-4


@pytest.mark.parametrize("table", ["chen", "harase"])
@pytest.mark.parametrize("m", range(10, 17))
def test_registers_have_the_full_period_and_all_values(m: int, table: str) -> None:
    """2^m - 1 different numbers; their mean is that of all words but zero."""
    register = LFSR(m, table)
    numbers = register.numbers(0, register.period)
    assert len(np.unique(numbers)) == register.period
    assert (register.numbers(register.period, register.period + 5) == numbers[:5]).all()
    mean = 0.5 * 2**m / register.period * (1 - 2.0**-32)
    assert numbers.mean() == pytest.approx(mean, rel=1e-13)
    assert register.numbers(700, 720).tolist() == numbers[700:720].tolist()


@pytest.mark.parametrize("m", range(17, 33))
def test_long_registers_return_to_where_they_began(m: int) -> None:
    """After 2^m - 1 numbers, and after no proper divisor of it."""
    register = LFSR(m)
    first = register.numbers(0, 4).tolist()
    assert register.numbers(register.period, register.period + 4).tolist() == first
    for prime in (3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 41, 43, 47, 73, 89, 127, 151, 241, 257, 331, 683):
        if register.period % prime == 0:
            part = register.period // prime
            assert register.numbers(part, part + 4).tolist() != first


def test_the_first_numbers_are_those_of_the_paper() -> None:
    np.testing.assert_allclose(LFSR(10, "chen").numbers(0, 4), [0.5004926, 0.8886435, 0.7536907, 0.8506772], atol=5e-8)


T_VALUES = {
    ("chen", 10): [2, 5, 5, 5],
    ("chen", 11): [2, 5, 5, 6],
    ("chen", 12): [2, 3, 5, 5],
    ("harase", 10): [0, 3, 3, 4],
    ("harase", 11): [0, 3, 3, 5],
    ("harase", 12): [0, 3, 4, 5],
}


@pytest.mark.parametrize(("table", "m"), T_VALUES)
def test_overlapping_rows_are_nets_of_the_published_quality(table: str, m: int) -> None:
    numbers = LFSR(m, table).numbers(0, 2**m + 4)
    found = []
    for s in (2, 3, 4, 5):
        rows = np.stack([numbers[j : j + 2**m - 1] for j in range(s)], axis=1)
        found.append(quality.smallest_t(np.concatenate([np.zeros((1, s)), rows])))
    assert found == T_VALUES[table, m]


def correlated(rho: float) -> Gibbs:
    rest = (1 - rho * rho) ** 0.5
    return Gibbs(
        [
            lambda x, u: rho * x[:, 1] + rest * special.ndtri(u),
            lambda x, u: rho * x[:, 0] + rest * special.ndtri(u),
        ]
    )


@pytest.mark.parametrize(("table", "least"), [("chen", 300), ("harase", 2000)])
def test_variance_reduction_on_the_bivariate_normal(table: str, least: float) -> None:
    """Of E x_1 = 0 at rho = 1/2, n = 1024; 1,000 repetitions give the ratio to 6 %; reference: 545 and 3,700 ± 50 %."""
    first = {"x": lambda x: x[:, 0]}
    even = run(
        correlated(0.5), [0, 0], points=LFSR(10, table), chains=1000, functionals=first, keep_draws=False, seed=1
    )
    random = run(correlated(0.5), [0, 0], n=1024, chains=1000, functionals=first, keep_draws=False, seed=2)
    assert np.mean(random.means["x"] ** 2) / np.mean(even.means["x"] ** 2) > least
