"""Integration: exact answers, tolerances, bad values, and arguments that are refused."""

from __future__ import annotations

import json
import math
import warnings
from typing import Any

import numpy as np
import pytest
from scipy.stats import qmc

import evenlight
from conftest import Run
from evenlight import quality
from evenlight.estimate import NotConvergedWarning
from evenlight.points import Halton, Independent, LatinHypercube, Sobol
from evenlight.rules import RULES


def product(x: np.ndarray) -> np.ndarray:
    return np.asarray(x.prod(axis=1))


@pytest.mark.parametrize("points", [Independent(3, seed=1), Sobol(3, seed=1), Halton(3, seed=1), LatinHypercube(3)])
def test_exact_answers_lie_within_four_standard_errors(points: Any) -> None:
    estimate = evenlight.integrate(product, points, n=2**12)
    assert abs(estimate.value - 0.125) < 4 * estimate.standard_error  # false alarm 6e-5, with t tails 1e-3
    assert estimate.n == estimate.cost == 2**12
    assert estimate.converged


def test_the_error_is_the_spread_of_the_replicates() -> None:
    sobol = Sobol(2, seed=3)
    estimate = evenlight.integrate(product, sobol, n=8 * 64, replicates=8)
    means = np.array([product(sobol.replicate(r).points(0, 64)).mean() for r in range(8)])
    assert estimate.value == pytest.approx(means.mean(), rel=1e-14)
    assert estimate.standard_error == pytest.approx(means.std(ddof=1) / math.sqrt(8), rel=1e-10)
    assert estimate.degrees_of_freedom == 7


def test_blocks_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = evenlight.integrate(product, Sobol(2, seed=3), n=16 * 256)
    monkeypatch.setattr("evenlight.integrand._MOST_NUMBERS", 16 * 2 * 10)
    pieces = evenlight.integrate(product, Sobol(2, seed=3), n=16 * 256)
    assert pieces.value == pytest.approx(whole.value, rel=1e-14)
    assert pieces.standard_error == pytest.approx(whole.standard_error, rel=1e-9)


def test_deterministic_points_claim_no_error_unless_a_bound_is_given() -> None:
    halton = Halton(1, scramble="none")
    estimate = evenlight.integrate(lambda x: x[:, 0] ** 2, halton, n=64)
    assert math.isnan(estimate.standard_error)
    assert all(math.isnan(end) for end in estimate.confidence_interval())
    # the first 2^k points of van der Corput are i / 2^k: star discrepancy 1 / n, and x² varies by 1
    low, high = evenlight.integrate(lambda x: x[:, 0] ** 2, halton, n=64, bound=1 / 64).confidence_interval()
    assert low <= 1 / 3 <= high


def test_arrays_are_integrated_entry_by_entry() -> None:
    both = evenlight.integrate(lambda x: np.stack([x, x**2], axis=2), Sobol(3, seed=1), n=2**12)
    assert np.shape(both.value) == np.shape(both.standard_error) == (3, 2)
    alone = evenlight.integrate(lambda x: x[:, 1] ** 2, Sobol(3, seed=1), n=2**12)
    assert both.value[1, 1] == pytest.approx(alone.value, rel=1e-14)
    assert np.shape(both.confidence_interval(0.9).low) == (3, 2)


@pytest.mark.parametrize("points", [Sobol(2, seed=5), Independent(2, seed=5), Halton(2, seed=5)])
def test_tolerances_are_met_and_said(points: Any) -> None:
    estimate = evenlight.integrate(product, points, rtol=1e-2, level=0.999)
    assert estimate.converged
    assert abs(estimate.value - 0.25) <= 1e-2 * 0.25
    low, high = estimate.confidence_interval(0.999)
    assert (high - low) / 2 <= 1e-2 * 0.25 * 1.03
    assert estimate.sequential


def test_a_run_goes_on_where_it_stopped() -> None:
    counted: list[int] = []

    def f(x: np.ndarray) -> np.ndarray:
        counted.append(len(x))
        return product(x)

    estimate = evenlight.integrate(f, Sobol(2, seed=5), atol=1e-5)
    assert sum(counted) == estimate.n


def test_reaching_the_limit_is_said_and_warned_of() -> None:
    with pytest.warns(NotConvergedWarning, match="max_n = 4096 reached"):
        estimate = evenlight.integrate(product, Independent(2), atol=1e-9, max_n=4096)
    assert not estimate.converged
    assert estimate.n == 4096
    assert "converged=False" in repr(estimate)


def test_values_without_spread_are_not_believed_at_once() -> None:
    """A region of probability 2e-4: the first 1,024 values are mostly all 0."""
    rare = lambda x: (x[:, 0] < 2e-4).astype(float)  # noqa: E731
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", NotConvergedWarning)
        runs = [evenlight.integrate(rare, Independent(1, seed=s), atol=1e-4, max_n=2**18).value for s in range(40)]
    assert sum(value == 0 for value in runs) <= 16  # e^(-8192 * 2e-4) = 19 % of runs; 40 runs, three sigma
    assert evenlight.integrate(lambda x: np.ones(len(x)), Sobol(1), rtol=1e-3).value == 1.0


def test_the_first_bad_value_is_named() -> None:
    def f(x: np.ndarray) -> np.ndarray:
        return np.where(x[:, 0] > 0.99, np.nan, x[:, 0])

    with pytest.raises(ValueError, match=r"f is nan at x = \[0\.99.*point \d+ of replicate 0"):
        evenlight.integrate(f, Sobol(1, seed=1), n=16 * 1024)
    for points in (Sobol(1, seed=1), Independent(1, seed=1), Sobol(1, scramble="none")):
        estimate = evenlight.integrate(f, points, n=2**14, on_nonfinite="skip-and-count")
        skipped = estimate.diagnostics["skipped"]
        assert skipped == pytest.approx(0.01 * 2**14, abs=6 * 13)
        assert estimate.value == pytest.approx(0.495, abs=0.015)


def test_the_median_beats_the_mean_for_smooth_integrands() -> None:
    """31 linear scrambles of 1,024 points, x e^x (integral 1): medians err by 3e-10, means by 1e-6."""
    f = lambda x: x[:, 0] * np.exp(x[:, 0])  # noqa: E731
    errors: dict[str, list[float]] = {"median": [], "rqmc": []}
    for method, found in errors.items():
        for seed in range(40):
            points = Sobol(1, scramble="linear", seed=seed)
            estimate = evenlight.integrate(f, points, n=31 * 1024, replicates=31, method=method)
            found.append(estimate.value - 1.0)
    medians, means = (math.sqrt(np.mean(np.square(found))) for found in errors.values())
    assert medians < 2e-9
    assert means > 1e-7


def test_medians_of_means_are_robust_against_heavy_tails() -> None:
    """Pareto values with infinite third moment: the worst of 200 medians is far closer than the worst mean."""
    f = lambda x: (1 - x[:, 0]) ** -0.48  # noqa: E731
    worst = {
        method: max(
            abs(
                evenlight.integrate(f, Independent(1, seed=s), n=15 * 128, replicates=15, method=method).value
                - 1 / 0.52
            )
            for s in range(200)
        )
        for method in ("mc", "median")
    }
    assert worst["median"] < 0.7 * worst["mc"]


def test_progress_is_told() -> None:
    seen: list[dict[str, Any]] = []
    evenlight.integrate(product, Sobol(2), rtol=1e-4, progress=seen.append)
    assert [state["done"] for state in seen] == [2048 * 2**k for k in range(len(seen))]
    assert seen[-1]["relative_error"] < seen[0]["relative_error"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "give n"),
        ({"n": 64, "rtol": 0.1}, "give one of them"),
        ({"n": 100}, "no multiple of 16 replicates; 96 is"),
        ({"n": 64, "replicates": 1}, "at least 2 replicates"),
        ({"rtol": 0.0}, "never reached"),
        ({"rtol": -1.0}, "rtol must be at least 0"),
        ({"atol": math.nan}, "atol must be at least 0"),
        ({"n": 64, "level": 95}, "level must be between 0 and 1"),
        ({"n": 64, "method": "cubature"}, "known: auto, mc, qmc, rqmc, median"),
        ({"n": 64, "method": "mc"}, "use 'rqmc'"),
        ({"n": 64, "bound": 1.0}, "bound goes with method 'qmc'"),
        ({"n": 64, "on_nonfinite": "ignore"}, "raise, skip-and-count"),
        ({"rtol": 0.1, "max_n": 3}, "not enough for 16 replicates"),
    ],
)
def test_arguments_without_meaning_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        evenlight.integrate(product, Sobol(2), **arguments)


def test_points_that_cannot_do_what_is_asked_are_refused() -> None:
    with pytest.raises(ValueError, match="no error estimate"):
        evenlight.integrate(product, Sobol(2, scramble="none"), rtol=0.1)
    with pytest.raises(ValueError, match="cannot grow"):
        evenlight.integrate(product, LatinHypercube(2, n=64), rtol=0.1)
    with pytest.raises(ValueError, match="no randomness"):
        evenlight.integrate(product, Sobol(2, scramble="none"), n=64, method="rqmc")


@pytest.mark.parametrize(
    ("f", "message"),
    [
        (lambda x: 1.0, r"shape \(1024, ...\)"),
        (lambda x: x.T, r"shape \(1024, ...\)"),
        (lambda x: x[:, 0] * 1j, "must be real"),
        (lambda x: ["a"] * len(x), "must return numbers"),
        (3, "must be a function"),
    ],
)
def test_functions_that_return_something_else_are_refused(f: Any, message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        evenlight.integrate(f, Sobol(2), n=1024)


def test_errors_of_the_function_come_through_unchanged() -> None:
    def f(x: np.ndarray) -> np.ndarray:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        evenlight.integrate(f, Sobol(2), n=64)


def test_every_rule_has_its_file() -> None:
    from conftest import ROOT

    files = {path.stem for path in (ROOT / "python/evenlight/rules").glob("*.py")}
    assert files == {*RULES, "__init__", "protocol"}


def test_the_command_line_integrates(evenlight_command: Run) -> None:
    done = evenlight_command("integrate", "keister", "--dims", "3", "--rtol", "1e-3", "--json")
    found = json.loads(done.stdout)
    assert done.returncode == 0
    assert abs(found["value"] - found["exact"]) <= 1e-3 * found["exact"]
    assert found["interval"][0] < found["value"] < found["interval"][1]
    late = evenlight_command("integrate", "ball", "--sequence", "independent", "--atol", "1e-6", "--max-n", "4096")
    assert "warning: max_n = 4096 reached" in late.stderr
    assert "converged=False" in late.stdout
    wrong = evenlight_command("integrate", "keister", "--n", "100")
    assert wrong.returncode == 2
    assert "no multiple of 16 replicates" in wrong.stderr


@pytest.mark.parametrize(
    ("d", "n", "kind"), [(1, 100, "exact"), (2, 1000, "exact"), (3, 256, "exact"), (8, 1024, "upper")]
)
def test_koksma_and_hlawka_bound_errors(d: int, n: int, kind: str) -> None:
    """x_1 ... x_d: over every face the variation in the sense of Vitali is 1, so that V = 2^d - 1."""
    variation = quality.hardy_krause_variation(product, d, size=1)
    assert variation.value == pytest.approx(2**d - 1)
    estimate = evenlight.integrate(product, Sobol(d, scramble="none"), n=n, variation=variation)
    star = estimate.diagnostics["star_discrepancy"]
    assert star.kind == kind
    assert estimate.diagnostics["bound"] == pytest.approx((2**d - 1) * float(star))
    low, high = estimate.confidence_interval()
    assert low <= 0.5**d <= high
    assert json.dumps(estimate.to_dict())


def test_bounds_are_for_fixed_points_and_finite_values() -> None:
    fixed = Sobol(2, scramble="none")
    with pytest.raises(ValueError, match="a bound goes with method 'qmc'"):
        evenlight.integrate(product, Sobol(2), n=64, variation=3.0)
    with pytest.raises(ValueError, match="give one of them"):
        evenlight.integrate(product, fixed, n=64, variation=3.0, bound=0.1)
    gap = lambda x: np.where(x[:, 0] > 0.9, np.nan, 1.0)  # noqa: E731
    with pytest.raises(ValueError, match="no finite variation"):
        evenlight.integrate(gap, fixed, n=64, variation=3.0, on_nonfinite="skip-and-count")


@pytest.mark.parametrize(
    ("method", "source"),
    [
        ("mc", Independent(3, seed=1)),
        ("rqmc", Halton(3, seed=1)),
        ("median", Sobol(3, seed=1, scramble="linear")),
        ("qmc", Sobol(3, scramble="none")),
    ],
)
def test_runs_resume_without_computing_values_again(method: str, source: Any) -> None:
    seen = []

    def f(x: np.ndarray) -> np.ndarray:
        seen.append(len(x))
        return np.stack([product(x), np.exp(x[:, 0])], axis=1)

    first = evenlight.integrate(f, source, n=1024, method=method)
    more = evenlight.integrate(f, source, n=4096, method=method, resume=first)
    assert sum(seen) == 4096
    whole = evenlight.integrate(f, source, n=4096, method=method)
    np.testing.assert_allclose(more.value, whole.value, rtol=1e-13)
    np.testing.assert_allclose(more.standard_error, whole.standard_error, rtol=1e-6)
    assert (more.n, more.cost, more.sequential) == (4096, 4096, True)
    if method != "qmc":
        assert (more.half_width(0.95) > whole.half_width(0.95)).all()


def test_a_run_resumes_up_to_a_smaller_tolerance() -> None:
    source = Sobol(3, seed=1)
    coarse = evenlight.integrate(product, source, atol=1e-3)
    fine = evenlight.integrate(product, source, atol=1e-5, resume=coarse)
    whole = evenlight.integrate(product, source, atol=1e-5)
    assert (fine.n, fine.value) == (whole.n, pytest.approx(whole.value, rel=1e-13))
    assert fine.n > coarse.n


def test_what_does_not_fit_does_not_resume() -> None:
    source = Sobol(3, seed=1)
    first = evenlight.integrate(product, source, n=1024)
    for source_, settings, message in (
        (Sobol(3, seed=2), {"n": 2048}, "must be an estimate by 'rqmc' from Sobol"),
        (source, {"n": 2048, "method": "median"}, "must be an estimate by 'median'"),
        (source, {"n": 2048, "replicates": 8}, "has 16 replicates, not 8"),
        (source, {"n": 512}, "has 1024 function values already, more than 512"),
        (LatinHypercube(3, seed=1), {"n": 2048}, "cannot grow"),
    ):
        with pytest.raises(ValueError, match=message):
            evenlight.integrate(product, source_, resume=first, **settings)


def test_medians_merge_into_the_median_of_all() -> None:
    """As if it had been one run of all replicates; with sizes that differ, each counts by its values."""
    runs = [
        evenlight.integrate(product, Sobol(3, seed=seed, scramble="linear"), n=1024, method="median")
        for seed in range(3)
    ]
    merged = runs[0].merge(runs[1]).merge(runs[2])
    again = runs[2].merge(runs[0].merge(runs[1]))
    replicates = np.concatenate([run.diagnostics["replicates"] for run in runs])
    assert merged.value == again.value == np.median(replicates)
    assert merged.standard_error == again.standard_error
    assert (merged.n, merged.replicates) == (3072, 48)
    spread = 1.482602 * np.median(np.abs(replicates - np.median(replicates)))
    assert merged.standard_error == pytest.approx(math.sqrt(math.pi / 2 / 47) * spread)
    assert merged.degrees_of_freedom == pytest.approx(0.37 * 47)
    larger = evenlight.integrate(product, Sobol(3, seed=9, scramble="linear"), n=4096, method="median")
    both = runs[0].merge(larger)
    assert both.value == pytest.approx((runs[0].value + 4 * larger.value) / 5, rel=1e-12)
    mean = evenlight.integrate(product, Sobol(3, seed=10), n=1024)
    assert runs[0].merge(mean).method == "median+rqmc"
    for kind in ("unskewed", "percentile-t"):
        with pytest.raises(ValueError, match="kind='t'"):
            merged.confidence_interval(kind=kind)


def test_a_design_serves_any_number_of_runs() -> None:
    """What one run makes of it stays in that run."""
    design = LatinHypercube(3, seed=1)
    found = {n: evenlight.integrate(product, design, n=n).value for n in (64, 128)}
    assert design.n is None
    assert found[128] == evenlight.integrate(product, LatinHypercube(3, seed=1), n=128).value


def test_a_run_up_to_a_tolerance_tells_what_it_saw() -> None:
    estimate = evenlight.integrate(product, Sobol(3, seed=1), atol=1e-5)
    looks = estimate.diagnostics["looks"]
    assert [n for n, _, _ in looks] == [2048 * 2**k for k in range(len(looks))]
    assert looks[-1] == (estimate.n, estimate.value, estimate.standard_error)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (Sobol, r"a sequence of so many dimensions, Sobol\(d\), not its class"),
        (np.zeros((64, 2)), "a sequence such as .* not numpy.ndarray"),
        (qmc.Sobol(2), "not scipy.stats._qmc.Sobol"),
        (2, "not builtins.int"),
    ],
)
def test_what_is_no_sequence_is_refused_by_name(points: Any, message: str) -> None:
    for estimate in (evenlight.integrate, lambda f, points, n: evenlight.quantile(f, points, 0.5, n=n)):
        with pytest.raises(TypeError, match=message):
            estimate(product, points, n=64)
