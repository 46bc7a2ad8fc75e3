"""Driving sequences: periods, tables, shifts; known variance reductions of Gibbs samplers."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from evenlight import mcmc, quality
from evenlight.mcmc import DRIVING, LCG, LFSR, Antithetic, Gibbs, IndependentNumbers, Permuted, Stratified, run
from evenlight.points import LatinHypercube, Sobol

CASES: dict[str, Any] = {
    "independent": IndependentNumbers(),
    "lfsr": LFSR(10),
    "lcg": LCG(10),
    "permuted": Permuted(Sobol(3)),
    "antithetic": Antithetic(),
    "stratified": Stratified(4),
}


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
    n = driving.length(3) or 100
    numbers = driving.stream(3, n, 2000, 3)(17, 18)[driving.coupled - 1 :: driving.coupled, 0, 1]
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


@pytest.mark.parametrize("m", range(10, 21))
def test_generators_have_the_full_period(m: int) -> None:
    generator = LCG(m)
    states = np.sort(np.rint(generator.numbers(0, generator.period) * generator.length(2)))
    assert (states == np.arange(1, generator.period + 1)).all()
    assert generator.numbers(generator.period + 3, generator.period + 4) == generator.numbers(3, 4)


@pytest.mark.parametrize("m", range(21, 25))
def test_multipliers_of_long_generators_are_primitive_roots(m: int) -> None:
    """After no proper divisor of the period is the generator where it began."""
    generator = LCG(m)
    first = generator.numbers(0, 1)
    assert generator.numbers(generator.period, generator.period + 1) == first
    rest, prime = generator.period, 2
    while rest > 1:
        if rest % prime == 0:
            part = generator.period // prime
            assert generator.numbers(part, part + 1) != first
            rest //= prime
        else:
            prime += 1


@pytest.mark.parametrize("driving", [LFSR(10), LCG(10)])
@pytest.mark.parametrize("dims", [1, 2, 3, 5, 11])
def test_every_row_is_used_once(driving: Any, dims: int) -> None:
    """First numbers of the rows, less the shift: all values, 0 included."""
    n = driving.length(dims)
    assert len(np.unique(driving.stream(dims, n, 1, 5)(0, n)[0, :, 0])) == n


def test_permuted_rows_are_the_points_in_another_order() -> None:
    rows = Permuted(Sobol(2)).stream(2, 256, 3, 9)(0, 256)
    points = Sobol(2).replicate(9).points(0, 256, replicates=3)
    for ours, theirs in zip(rows, points, strict=True):
        assert sorted(map(tuple, ours)) == sorted(map(tuple, theirs))
        assert not (ours == theirs).all()
    assert Permuted(LatinHypercube(2, n=100)).length(2) == 100


def test_stratified_numbers_are_latin_hypercubes() -> None:
    numbers = Stratified(5).stream(3, 20, 4, 1)(0, 20).reshape(4, 5, 20, 3)
    assert (np.sort((numbers * 5).astype(int), axis=1) == np.arange(5)[None, :, None, None]).all()


def test_coupled_chains_are_one_replicate() -> None:
    """Antithetic pairs of a linear Gibbs sampler: E x_1 without any error, E x_1^2 with one."""
    chains = run(correlated(0.5), [0, 0], n=100, points=Antithetic(), chains=20, seed=1)
    estimate = chains.estimate(lambda x: np.stack([x[:, 0], x[:, 0] ** 2], axis=1))
    assert estimate.replicates == 10
    assert abs(estimate.value[0]) < 1e-12 and estimate.standard_error[0] < 1e-12
    assert abs(estimate.value[1] - 1) < 5 * estimate.standard_error[1] < 1


def test_antithetic_registers_add_up() -> None:
    """LFSR-driven pairs: what is odd cancels, what is even keeps the gain of the register."""
    square = {"x^2": lambda x: x[:, 0] ** 2}
    pairs = run(correlated(0.5), [0, 0], points=Antithetic(LFSR(10)), chains=400, functionals=square, seed=1)
    alone = run(correlated(0.5), [0, 0], points=LFSR(10), chains=200, functionals=square, seed=2)
    variances = [np.var(chains.means["x^2"].reshape(200, -1).mean(axis=1)) for chains in (pairs, alone)]
    assert variances[0] < 1.5 * variances[1]  # two standard errors of the ratio above equality


def test_stratified_chains_gain_where_chains_forget() -> None:
    """Variance of the mean over 16 chains of a Gibbs sampler with rho = 0.3, against independent chains."""
    first = {"x": lambda x: x[:, 0]}
    variances = []
    for points in (Stratified(16), IndependentNumbers()):
        chains = run(correlated(0.3), [0, 0], n=64, points=points, chains=1600, functionals=first, seed=3)
        variances.append(np.var(chains.means["x"].reshape(100, 16).mean(axis=1)))
    assert variances[0] < 0.1 * variances[1]


@pytest.mark.parametrize(
    ("points", "least"),
    [(LCG(10), 50), (Permuted(Sobol(2)), 2), (Permuted(LatinHypercube(2, n=1024)), 2)],
)
def test_other_sequences_reduce_the_variance_too(points: Any, least: float) -> None:
    first = {"x": lambda x: x[:, 0]}
    n = points.length(2) or 1024
    even = run(correlated(0.5), [0, 0], n=n, points=points, chains=300, functionals=first, keep_draws=False, seed=1)
    random = run(correlated(0.5), [0, 0], n=n, chains=300, functionals=first, keep_draws=False, seed=2)
    assert np.mean(random.means["x"] ** 2) / np.mean(even.means["x"] ** 2) > least


WRONG: Any = 3


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: LCG(25), ValueError, "m must be 10 to 24, not 25"),
        (lambda: LFSR(10, "knuth"), ValueError, "unknown table 'knuth'; known: harase, chen"),
        (lambda: Permuted(WRONG), TypeError, "points must be a sequence of evenlight.points"),
        (lambda: Permuted(Sobol(2, scramble="none")), ValueError, "is not random"),
        (lambda: Permuted(Sobol(3)).stream(2, 8, 1, 1), ValueError, "a step takes 2 uniform numbers"),
        (lambda: Antithetic(WRONG), TypeError, "points must be a driving sequence"),
        (lambda: Antithetic(Stratified(4)), ValueError, "couples 4 chains already"),
        (lambda: Stratified(1), ValueError, "coupled must be at least 2"),
        (lambda: run(correlated(0.5), [0, 0], n=9, chains=6, points=Stratified(4)), ValueError, "multiple of the 4"),
    ],
)
def test_what_cannot_drive_is_refused(call: Any, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        call()
