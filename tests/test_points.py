"""Contracts of the point sequences: SciPy's protocol, exact bits, random access, clear refusals."""

from __future__ import annotations

import copy
import doctest
import importlib
import pickle
import re
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy.integrate import qmc_quad
from scipy.stats import _qmc, qmc

from conftest import fitting_count, fitting_dims
from evenlight import points
from evenlight.points import Engine, Halton, Independent, Sobol, VanDerCorput

ENGINES: list[tuple[str, dict[str, Any]]] = [
    (info.name, {} if len(info.scrambles) == 1 else {"scramble": scramble})
    for info in points.available()
    for scramble in info.scrambles
]
IDS = [f"{name}-{settings.get('scramble', 'none')}" for name, settings in ENGINES]
BALANCE = pytest.mark.filterwarnings("ignore:.*are balanced in powers of.*:UserWarning")  # bases are not all 2


def every_engine(test: Callable[..., None]) -> Callable[..., None]:
    """Run a test on every sequence with every scramble."""
    run: Callable[..., None] = BALANCE(pytest.mark.parametrize(("name", "settings"), ENGINES, ids=IDS)(test))
    return run


# Sets whose rows are in order: only the whole is even.
IN_ORDER = ("hammersley", "korobov", "fibonacci")


def engine(name: str, settings: dict[str, Any], d: int = 3, seed: int = 11, rows: int = 17_000) -> Engine:
    """An engine; `rows` are how many a test draws, for the sets whose rows are in order."""
    least = 1 if name == "stratified" and d > 10 else rows if name in IN_ORDER else 17_000
    d = fitting_dims(name, d)
    return points.SEQUENCES[name](d, seed=seed, **fitting_count(name, d, least), **settings)


def whole(sequence: Engine, rows: int) -> int:
    """So many rows, or all there are of a set whose rows are in order."""
    return sequence.n or rows if sequence.sequence in IN_ORDER else rows


# --- SciPy's protocol: the checks of its own QMCEngineTests, but exact to the bit ---


@every_engine
def test_rows_are_in_the_half_open_cube(name: str, settings: dict[str, Any]) -> None:
    sample = engine(name, settings, d=10).random(1024)
    assert sample.shape == (1024, fitting_dims(name, 10))
    assert sample.dtype == np.float64
    assert sample.min() >= 0
    assert sample.max() < 1


@every_engine
def test_no_rows_are_an_empty_array(name: str, settings: dict[str, Any]) -> None:
    assert engine(name, settings).random(0).shape == (0, fitting_dims(name, 3))


@every_engine
def test_drawing_in_parts_is_drawing_at_once(name: str, settings: dict[str, Any]) -> None:
    parts = engine(name, settings)
    joined = np.concatenate([parts.random(4), parts.random(1), parts.random(3)])
    assert parts.num_generated == 8
    np.testing.assert_array_equal(joined, engine(name, settings).random(8))


@every_engine
def test_reset_begins_again(name: str, settings: dict[str, Any]) -> None:
    sequence = engine(name, settings)
    first = sequence.random(8)
    assert sequence.reset() is sequence
    assert sequence.num_generated == 0
    np.testing.assert_array_equal(sequence.random(8), first)


@every_engine
@pytest.mark.parametrize("skipped", [0, 1, 5, 2**40])
def test_fast_forward_skips_rows(name: str, settings: dict[str, Any], skipped: int) -> None:
    sequence = engine(name, settings)
    if sequence.n is not None and sequence.n < skipped + 4:
        pytest.skip("has no such row")
    assert sequence.fast_forward(skipped) is sequence
    np.testing.assert_array_equal(sequence.random(4), engine(name, settings).points(skipped, skipped + 4))


@every_engine
def test_more_dimensions_keep_the_first(name: str, settings: dict[str, Any]) -> None:
    if name in ("stratified", "faure", "niederreiter_xing", "kronecker"):
        pytest.skip("its grid, base, matrices or numbers depend on the number of dimensions")
    few, many = engine(name, settings, d=2).random(16), engine(name, settings, d=40).random(16)
    np.testing.assert_array_equal(few, many[:, :2])


@every_engine
def test_moments_are_those_of_the_uniform_distribution(name: str, settings: dict[str, Any]) -> None:
    sequence = engine(name, settings, d=5, rows=2**14)
    sample = sequence.points(0, whole(sequence, 2**14))
    # Five standard deviations for independent rows, far more for all others.
    assert np.abs(sample.mean(axis=0) - 1 / 2).max() < 5 / np.sqrt(12 * 2**14)
    assert np.abs(sample.var(axis=0) - 1 / 12).max() < 5 / np.sqrt(180 * 2**14)
    np.testing.assert_allclose(np.percentile(sample, 25, axis=0), 0.25, atol=0.02)


@every_engine
def test_scipy_draws_integers(name: str, settings: dict[str, Any]) -> None:
    sequence = engine(name, settings, rows=256)
    sample = sequence.integers(2, u_bounds=[5, 6, 7][: sequence.d], n=256)
    assert sample.min() == 2
    assert sample.max(axis=0).tolist() == [4, 5, 6][: sequence.d]


@every_engine
def test_scipy_integrates_with_it(name: str, settings: dict[str, Any]) -> None:
    def f(x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
        product: npt.NDArray[np.float64] = (3 * x**2).prod(axis=0)
        return product

    sequence = engine(name, settings, rows=1024)
    zeros, ones = np.zeros(sequence.d), np.ones(sequence.d)
    found = qmc_quad(f, zeros, ones, n_points=whole(sequence, 1024), n_estimates=8, qrng=sequence)
    assert found.integral == pytest.approx(1, abs=max(6 * found.standard_error, 0.02))
    if settings.get("scramble") != "none":
        assert 0 < found.standard_error < 0.05


def test_scipy_makes_normal_points() -> None:
    normal = qmc.MultivariateNormalQMC(np.zeros(3), engine=Sobol(3, seed=1)).random(1024)
    assert np.isfinite(normal).all()
    assert np.abs(normal.mean(axis=0)).max() < 0.01


# --- seeds ---


@every_engine
def test_same_seed_same_bits(name: str, settings: dict[str, Any]) -> None:
    first, again = engine(name, settings, seed=5), engine(name, settings, seed=5)
    np.testing.assert_array_equal(first.random(16), again.random(16))
    default = points.SEQUENCES[name](first.d, **fitting_count(name, int(first.d), 17_000), **settings)
    np.testing.assert_array_equal(default.random(16), engine(name, settings, seed=0).random(16))
    if settings.get("scramble") != "none":
        assert not np.array_equal(first.points(0, 4), engine(name, settings, seed=6).points(0, 4))


def test_seed_and_rng_are_the_same_argument() -> None:
    np.testing.assert_array_equal(Sobol(2, rng=9).random(8), Sobol(2, seed=9).random(8))
    generator = np.random.default_rng(3)
    one, two = Sobol(2, rng=generator), Sobol(2, seed=generator)
    assert one.seed != two.seed
    assert one.seed == Sobol(2, rng=np.random.default_rng(3)).seed
    assert Sobol(2, seed=2**64 - 1).seed == 2**64 - 1


@every_engine
def test_a_copy_goes_on_where_the_original_was(name: str, settings: dict[str, Any]) -> None:
    original = engine(name, settings)
    original.random(8)
    pickled, copied = pickle.loads(pickle.dumps(original)), copy.deepcopy(original)
    expected = original.random(8)
    np.testing.assert_array_equal(pickled.random(8), expected)
    np.testing.assert_array_equal(copied.random(8), expected)


@every_engine
def test_replicates_are_new_engines_with_their_own_seeds(name: str, settings: dict[str, Any]) -> None:
    sequence = engine(name, settings)
    if not sequence.is_random:
        with pytest.raises(ValueError, match="has no randomness to replicate"):
            sequence.replicate(0)
        return
    sequence.random(4)
    replicates = [sequence.replicate(r) for r in range(64)]
    assert len({replicate.seed for replicate in [sequence, *replicates]}) == 65
    assert {type(replicate) for replicate in replicates} == {type(sequence)}
    np.testing.assert_array_equal(replicates[5].random(4), engine(name, settings).replicate(5).points(0, 4))
    first = np.array([replicate.points(0, 1)[0] for replicate in replicates])
    # Five standard deviations of the mean of 64 independent uniform numbers.
    assert np.abs(first.mean(axis=0) - 0.5).max() < 5 / np.sqrt(12 * 64)


# --- known points ---


@pytest.mark.parametrize(("d", "m"), [(1, 4), (5, 10), (300, 6)])
def test_plain_sobol_points_are_those_of_scipy(d: int, m: int) -> None:
    ours = Sobol(d, scramble="none").random(2**m)
    theirs = qmc.Sobol(d, scramble=False).random(2**m)
    # SciPy's order is that of the Gray code: the same set of rows in every block of 2^m.
    np.testing.assert_array_equal(ours[np.lexsort(ours.T)], theirs[np.lexsort(theirs.T)])
    order = np.arange(2**m)
    np.testing.assert_array_equal(ours[order ^ (order >> 1)], theirs)


def test_the_last_sobol_dimension_is_that_of_scipy() -> None:
    order = np.arange(16)
    ours = Sobol(21_201, scramble="none").points(0, 16)
    np.testing.assert_array_equal(ours[order ^ (order >> 1)], qmc.Sobol(21_201, scramble=False).random(16))


def test_plain_halton_points_are_those_of_scipy() -> None:
    ours, theirs = Halton(50, scramble="none").random(500), qmc.Halton(50, scramble=False).random(500)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-15)


@pytest.mark.parametrize("base", [2, 3, 6, 10, 97, 65_521])
def test_plain_van_der_corput_points_are_those_of_scipy(base: int) -> None:
    ours = VanDerCorput(base=base, scramble="none").points(3, 2000).ravel()
    theirs = _qmc.van_der_corput(1997, base, start_index=3, scramble=False)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-15)


def test_scrambling_keeps_the_discrepancy_low() -> None:
    limit = 0.1 * qmc.discrepancy(Independent(4, seed=1).random(1024))
    assert qmc.discrepancy(Sobol(4, seed=1).random(1024)) < limit
    assert qmc.discrepancy(Halton(4, seed=1).random(1024)) < limit


# --- arrays ---


@every_engine
def test_points_go_into_the_given_array(name: str, settings: dict[str, Any]) -> None:
    sequence = engine(name, settings)
    expected = sequence.points(5, 25)
    out = np.empty(expected.shape)
    assert sequence.points(5, 25, out) is out
    np.testing.assert_array_equal(out, expected)
    single = sequence.points(5, 25, np.empty(expected.shape, dtype=np.float32))
    assert single.dtype == np.float32
    assert single.max() < 1
    gap = expected - single
    assert gap.min() >= 0
    assert gap.max() < 2**-24


@every_engine
def test_replicates_are_a_leading_axis(name: str, settings: dict[str, Any]) -> None:
    sequence = engine(name, settings)
    if not sequence.is_random:
        return
    stacked = sequence.points(3, 11, replicates=4)
    assert stacked.shape == (4, 8, sequence.d)
    for r, replicate in enumerate(stacked):
        np.testing.assert_array_equal(replicate, sequence.replicate(r).points(3, 11))
    single = np.empty(stacked.shape, dtype=np.float32)
    assert sequence.points(3, 11, single, replicates=4) is single
    np.testing.assert_allclose(single, stacked, atol=2**-24)


def test_scrambles_are_switched_as_in_scipy() -> None:
    assert Sobol(2, scramble=True).scramble == "owen"
    assert Sobol(2, scramble=False).scramble == "none"
    assert Sobol(2, seed=2**64).seed == Sobol(2, seed=2**64).seed < 2**64


# --- refusals ---


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: points.build("sobul", 2), "unknown sequence 'sobul'; known: sobol, halton, independent"),
        (lambda: Sobol(2, scramble="own"), "unknown scramble 'own'; known: none, shift, shift_tent, "),
        (lambda: points.build("sobol", 2, base=3), "sequence 'sobol' has no option 'base'; it has: none"),
        (lambda: points.build("independent", 2, scramble="owen"), "'owen'; accepted: none"),
        (lambda: Sobol(21_202), "1 to 21201 dimensions, not 21202"),
        (lambda: Halton(6_543), "1 to 6542 dimensions, not 6543"),
        (lambda: Sobol(-1), "d must be at least 0, not -1"),
        (lambda: Sobol(2, seed=-1), "seed must be at least 0, not -1"),
        (lambda: Sobol(2).points(0, 4, replicates=0), "replicates must be at least 1, not 0"),
        (lambda: Sobol(2, scramble="none").points(0, 4, replicates=2), "no randomness to replicate"),
        (lambda: Sobol(2).random(-1), "n must be at least 0, not -1"),
        (lambda: Sobol(2).fast_forward(-3), "n must be at least 0, not -3"),
        (lambda: Sobol(2).points(4, 3), "0 <= start <= stop"),
        (lambda: Sobol(2).points(0, 2**64), "0 <= start <= stop < 2\\^64"),
        (lambda: Sobol(2).points(-1, 3), "start must be at least 0, not -1"),
    ],
)
def test_wrong_values_are_named(build: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        build()


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: Sobol(2, sed=3), "Sobol has no argument 'sed'; it has: d, scramble, seed, rng, optimization$"),
        (lambda: Sobol(2.5), "d must be an integer, not float"),  # type: ignore[arg-type]
        (lambda: Sobol(2, seed="7"), "seed must be an integer, not str"),  # type: ignore[arg-type]
        (lambda: Sobol(2, scramble=3), "scramble must be a string, not int"),  # type: ignore[arg-type]
        (lambda: Sobol(2).random(1.5), "n must be an integer, not float"),  # type: ignore[arg-type]
        (lambda: Sobol(2, seed=1, rng=1), "two names for the same argument"),
    ],
)
def test_wrong_types_are_named(build: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        build()


def test_unbalanced_sobol_points_warn_once() -> None:
    sobol = Sobol(2)
    with pytest.warns(UserWarning, match="take n = 1024 or 512, not 1000"):
        sobol.random(1000)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sobol.random(3)
        sobol.reset().random(5)
        Sobol(2).random(64)
        Halton(2).random(1000)


@pytest.mark.parametrize("name", [name for name, sequence in points.SEQUENCES.items() if not sequence.finite])
def test_counts_that_break_the_balance_are_named_with_better_ones(name: str) -> None:
    d = fitting_dims(name, 2)
    sequence = points.build(name, d, seed=1, **fitting_count(name, d, 1000))
    base = sequence._core.base
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        sequence.random(1000)
        sequence.reset().random(1000)
        if base is not None:
            points.build(name, d, seed=1, **fitting_count(name, d, 1000)).random(base**3)
    assert len(caught) == (base is not None)
    for warning in caught:
        assert warning.category is UserWarning
        assert warning.filename == __file__
        found = re.search(r"powers of (\d+): take n = (\d+) or (\d+), not 1000", str(warning.message))
        assert found
        assert int(found[1]) == base
        more, less = int(found[2]), int(found[3])
        assert less < 1000 < more == less * base
        assert base ** round(np.log(less) / np.log(base)) == less
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", ".* are balanced in powers of")
        points.build(name, d, seed=1, **fitting_count(name, d, 1000)).random(1000)


def test_random_base2_keeps_totals_balanced() -> None:
    sobol = Sobol(2)
    np.testing.assert_array_equal(sobol.random_base2(3), sobol.points(0, 8))
    sobol.random_base2(3)
    with pytest.raises(ValueError, match="16 rows were drawn already"):
        sobol.random_base2(3)


# --- the registry ---


def test_every_registered_sequence_has_its_class_and_its_own_default() -> None:
    assert [info.name for info in points.available()] == list(points.SEQUENCES)
    for info in points.available():
        assert info.cite
        built = points.build(info.name, fitting_dims(info.name, 2), seed=4, **fitting_count(info.name, 2, 17_000))
        assert type(built) is points.SEQUENCES[info.name]
        assert built.scramble == info.scrambles[0]
        width = min(info.most_dims, 10**5)
        count = fitting_count(info.name, width, 1)
        assert points.build(info.name, width, **count).points(0, 1).max() < 1


def test_the_expression_that_builds_an_engine_is_its_representation() -> None:
    assert repr(Sobol(3, seed=7)) == "Sobol(3, scramble='owen', seed=7)"
    assert repr(Independent(3)) == "Independent(3, seed=0)"


@pytest.mark.parametrize("module", ["", ".engine", *(f".{name}" for name in points.SEQUENCES)])
def test_examples_in_the_documentation_run(module: str) -> None:
    found = doctest.testmod(importlib.import_module(f"evenlight.points{module}"))
    assert found.failed == 0
    assert found.attempted > 0
