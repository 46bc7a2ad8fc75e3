"""Measures of quality from Python: agreement with SciPy, objects that say what they are, refusals."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from scipy.stats import qmc

from evenlight import points, quality


@pytest.mark.parametrize("method", ["CD", "WD", "MD", "L2-star"])
def test_discrepancies_are_those_of_scipy(method: Any) -> None:
    generator = np.random.default_rng(7)
    for n, d in [(1, 1), (2, 3), (15, 2), (100, 1), (257, 4), (512, 9)]:
        x = generator.random((n, d))
        wanted = float(qmc.discrepancy(x, method=method))
        # a sum of n² numbers, less numbers of nearly the same size
        assert quality.discrepancy(x, method) == pytest.approx(wanted, rel=1e-9, abs=1e-13)
    squared = quality.discrepancy(x, method, convention="squared")
    assert quality.discrepancy(x, method, convention="root") == pytest.approx(squared**0.5, rel=1e-14)


def test_a_weight_of_nought_leaves_a_coordinate_out() -> None:
    x = np.random.default_rng(1).random((64, 3))
    for method in ("CD", "WD", "MD", "SD", "weighted-star"):
        left = quality.discrepancy(x, method, weights=[1, 0, 1])
        assert left == pytest.approx(quality.discrepancy(x[:, [0, 2]], method), rel=1e-10)


def test_a_star_discrepancy_says_what_it_is() -> None:
    x = points.Sobol(3, scramble="none").points(0, 64)
    star = quality.star_discrepancy(x)
    assert star == pytest.approx(0.078690, abs=1e-6)
    assert (star.kind, star.method, star.lower, star.upper) == ("exact", "dem", star.value, star.value)
    sign = 1 if star.closed else -1
    assert sign * quality.local_discrepancy(x, star.box, closed=star.closed) == pytest.approx(star.value)
    again = pickle.loads(pickle.dumps(star))
    assert again == star
    assert again.evidence == star.evidence
    lower = quality.star_discrepancy(x, "threshold_accepting", seed=3)
    upper = quality.star_discrepancy(x, "bracketing", brackets=1000)
    assert (lower.kind, upper.kind) == ("lower", "upper")
    assert lower.value <= lower.upper == 1
    assert lower <= star <= upper
    assert quality.star_discrepancy(x, limit=0).kind == "lower"
    assert quality.star_discrepancy(x, workers=2) == star


def test_progress_is_told_and_may_stop_the_work() -> None:
    x = points.Halton(3).points(0, 100)
    told: list[float] = []
    quality.star_discrepancy(x, "dem", progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1

    def stop(part: float) -> None:
        raise InterruptedError(f"at {part > 0}")

    with pytest.raises(InterruptedError, match="at True"):
        quality.star_discrepancy(x, "dem", progress=stop)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: quality.star_discrepancy([0.5, 0.5]), r"x must have shape \(n, d\)"),
        (lambda: quality.star_discrepancy([[0.5, 1.5]]), r"coordinate 1 of point 0 must be in \[0, 1\], not 1.5"),
        (lambda: quality.star_discrepancy([[0.5] * 3], "sweep"), "'sweep' is for 1 or 2 dimensions"),
        (lambda: quality.star_discrepancy([[0.5]], "guess"), "unknown method 'guess'; known: auto"),  # type: ignore[arg-type]
        (lambda: quality.star_discrepancy([[0.5]], trial=3), "unknown limit 'trial'; known: trials"),
        (lambda: quality.star_discrepancy([[0.5]], trials=0), "trials must be at least 1, not 0"),
        (lambda: quality.star_discrepancy([[0.5]], workers=0), "workers must be at least 1"),
        (lambda: quality.local_discrepancy([[0.5]], [0.5, 0.5]), "boxes of 2 dimensions for points of 1"),
        (lambda: quality.discrepancy([[0.5]], "L3"), "unknown method 'L3'; known: CD"),  # type: ignore[arg-type]
        (lambda: quality.discrepancy([[0.5]], convention="cubed"), "unknown convention 'cubed'"),  # type: ignore[arg-type]
        (lambda: quality.discrepancy([[0.5]], algorithm="fast"), "unknown algorithm 'fast'"),  # type: ignore[arg-type]
        (lambda: quality.discrepancy([[0.5]], weights=[1, 2]), "2 weights for 1 dimensions"),
    ],
)
def test_what_has_no_meaning_is_refused(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_what_is_certain_is_never_a_lower_bound() -> None:
    """Exact where that takes few steps, else an upper bound."""
    for d, limit, kind in ((2, 0, "exact"), (3, 1e10, "exact"), (3, 0, "upper")):
        x = points.Sobol(d, seed=2).points(0, 64)
        star = quality.star_discrepancy(x, "certain", limit=limit, brackets=16)
        assert star.kind == kind
        assert quality.star_discrepancy(x) <= star


def test_an_isotropic_discrepancy_says_what_it_is() -> None:
    x = np.random.default_rng(2).random((24, 2))
    lower, upper = quality.isotropic_discrepancy(x, sectors=16), quality.isotropic_discrepancy(x, "upper", sectors=16)
    assert (lower.kind, upper.kind) == ("lower", "upper")
    assert (lower, upper) == (lower.lower, lower.upper) == (upper.lower, upper.upper)
    assert quality.star_discrepancy(x) <= upper
    # the polygon by the shoelace formula and by its sides
    a, b = lower.vertices, np.roll(lower.vertices, -1, axis=0)
    area = float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()) / 2
    along, there = b - a, x[:, None] - a
    turns = along[:, 0] * there[..., 1] - along[:, 1] * there[..., 0]
    inside = (turns >= -1e-12 if lower.closed else turns > 1e-12).all(axis=1)
    assert lower == pytest.approx((inside.mean() - area) * (1 if lower.closed else -1), abs=1e-9)
    assert pickle.loads(pickle.dumps(lower)).evidence == lower.evidence
    assert quality.isotropic_discrepancy([[0.5, 0.5]], sectors=64).kind == "exact"
    with pytest.raises(ValueError, match="unknown bound 'exact'; known: lower, upper"):
        quality.isotropic_discrepancy(x, "exact")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="for 2 dimensions, not 3"):
        quality.isotropic_discrepancy([[0.5] * 3])
    with pytest.raises(ValueError, match=r"coordinate 0 of point 0 must be in \[0, 1\], not NaN"):
        quality.isotropic_discrepancy([[np.nan, 0.5]])
