"""Estimates: intervals, merging and plain values, against SciPy and exact numbers."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from scipy import stats

import evenlight
from evenlight.estimate import from_moments
from evenlight.moments import Moments
from evenlight.points import Independent, Sobol
from evenlight.stopping import sequential_quantile

VALUES = np.random.default_rng(5).exponential(size=(40, 2))


def estimate_of(values: np.ndarray, size: int = 1) -> evenlight.Estimate:
    return from_moments(((size, Moments.of(values)),), method="mc", cost=float(size * len(values)))


def test_moments_are_those_of_scipy_whatever_the_blocks() -> None:
    parts = [Moments.of(part) for part in np.split(VALUES, [0, 1, 7, 30])]
    left = parts[0].merge(parts[1]).merge(parts[2]).merge(parts[3]).merge(parts[4])
    right = parts[0].merge(parts[1].merge(parts[2].merge(parts[3].merge(parts[4]))))
    for moments in (left, right, Moments.of(VALUES)):
        np.testing.assert_allclose(moments.mean, VALUES.mean(axis=0), rtol=1e-13)
        np.testing.assert_allclose(moments.standard_error, stats.sem(VALUES), rtol=1e-13)
        np.testing.assert_allclose(moments.skewness, stats.skew(VALUES), rtol=1e-12)


def test_moments_survive_a_large_offset() -> None:
    shifted = Moments.of(VALUES[:7] + 1e9).merge(Moments.of(VALUES[7:] + 1e9))
    np.testing.assert_allclose(shifted.standard_error, stats.sem(VALUES), rtol=1e-6)


def test_the_t_interval_is_that_of_scipy() -> None:
    estimate = estimate_of(VALUES[:, 0])
    wanted = stats.ttest_1samp(VALUES[:, 0], 0.0).confidence_interval(0.9)
    interval = estimate.confidence_interval(0.9)
    np.testing.assert_allclose(np.array(interval), np.array([wanted.low, wanted.high]), rtol=1e-12)


def test_the_unskewed_interval_reaches_farther_where_the_tail_is() -> None:
    estimate = estimate_of(VALUES)
    low, high = estimate.confidence_interval(0.95, "unskewed")
    plain = estimate.confidence_interval(0.95)
    assert (high > plain.high).all()
    assert (low > plain.low).all()


def test_intervals_of_lopsided_exponentials_hold_the_truth_more_often_without_skewness() -> None:
    """20 values, 4,000 runs: the plain interval holds 92 %, the unskewed one 94 %; standard error 0.4 %."""
    runs = np.random.default_rng(1).exponential(size=(20, 4000))
    covered = {}
    for kind in ("t", "unskewed"):
        low, high = estimate_of(runs).confidence_interval(0.95, kind)
        covered[kind] = np.mean((low <= 1) & (high >= 1))
    assert covered["t"] < 0.93 < covered["unskewed"] < 0.96


def test_merging_equal_replicates_is_one_larger_run() -> None:
    merged = estimate_of(VALUES[:10], 64).merge(estimate_of(VALUES[10:], 64))
    whole = estimate_of(VALUES, 64)
    np.testing.assert_allclose(merged.value, whole.value, rtol=1e-13)
    np.testing.assert_allclose(merged.standard_error, whole.standard_error, rtol=1e-13)
    assert (merged.n, merged.replicates, merged.degrees_of_freedom) == (2560, 40, 39)


def test_the_order_of_merging_does_not_matter() -> None:
    a, b, c = estimate_of(VALUES[:10], 64), estimate_of(VALUES[10:15], 256), estimate_of(VALUES[15:], 64)
    for merged in (a.merge(b).merge(c), c.merge(a.merge(b)), b.merge(c.merge(a))):
        np.testing.assert_allclose(merged.value, a.merge(b).merge(c).value, rtol=1e-13)
        np.testing.assert_allclose(merged.standard_error, a.merge(b).merge(c).standard_error, rtol=1e-13)
        assert merged.degrees_of_freedom == pytest.approx(a.merge(b).merge(c).degrees_of_freedom)


def test_degrees_of_freedom_of_unequal_replicates_are_welchs() -> None:
    x, y = VALUES[:10, 0], VALUES[10:15, 0]
    merged = estimate_of(x, 100).merge(estimate_of(y, 200))  # each has half of the function values
    wanted = stats.ttest_ind(x, y, equal_var=False).df
    assert merged.degrees_of_freedom == pytest.approx(wanted)
    assert merged.value == pytest.approx((x.mean() + y.mean()) / 2)


def test_what_does_not_merge_says_so() -> None:
    f = lambda x: x[:, 0]  # noqa: E731
    one = evenlight.integrate(f, Sobol(1, seed=1), n=64)
    with pytest.raises(ValueError, match="same points"):
        one.merge(evenlight.integrate(f, Sobol(1, seed=1), n=128))
    with pytest.raises(ValueError, match="'qmc' does not merge"):
        one.merge(evenlight.integrate(f, Sobol(1, scramble="none"), n=64))
    with pytest.raises(TypeError, match="not with float"):
        one.merge(0.5)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="resume must be an estimate, not float"):
        evenlight.integrate(f, Sobol(1, seed=1), n=128, resume=0.5)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="shapes"):
        one.merge(estimate_of(VALUES))


def test_plain_values_are_json() -> None:
    f = lambda x: np.stack([x[:, 0], x.sum(axis=1)], axis=1)  # noqa: E731
    for points in (Sobol(2), Independent(2), Sobol(2, scramble="none")):
        plain = evenlight.integrate(f, points, n=64).to_dict()
        assert json.loads(json.dumps(plain, allow_nan=False)) == plain
        assert len(plain["value"]) == 2


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.123456, 0.0012, "0.1235 ± 0.0012"),
        (1234.56, 34.0, "1235 ± 34"),
        (2.498e-8, 3.1e-10, "2.498e-08 ± 3.1e-10"),
        (0.5, math.nan, "0.5"),
        (0.5, 0.0, "0.5 ± 0"),
    ],
)
def test_the_representation_shows_the_digits_that_matter(value: float, error: float, text: str) -> None:
    shown = evenlight.Estimate(value, error, 10, 2, 10.0, "mc")
    assert repr(shown).startswith(f"Estimate({text}, ")


def test_odd_levels_and_kinds_are_refused() -> None:
    with pytest.raises(ValueError, match="between 0 and 1"):
        estimate_of(VALUES).confidence_interval(1.0)
    with pytest.raises(ValueError, match="known: t, unskewed, percentile-t"):
        estimate_of(VALUES).confidence_interval(0.9, "z")
    with pytest.raises(ValueError, match="replicates"):
        estimate_of(VALUES).confidence_interval(0.9, "percentile-t")


def test_sequential_quantiles_keep_their_promise_in_simulation() -> None:
    """Normal replicates whose error halves every two looks: 20,000 runs, standard error 0.15 %, bar at 3."""
    generator = np.random.default_rng(3)
    degrees, runs = 15, 20_000
    quantile = sequential_quantile(0.95, degrees)
    for goal in (0.1, 0.14, 0.19):
        covered, running = np.zeros(runs, bool), np.ones(runs, bool)
        sums, count = np.zeros((runs, degrees + 1)), 0.0
        while running.any():
            added = max(count, 1.0)  # independent values: the spreads of different looks are correlated
            sums += np.sqrt(added) * generator.standard_normal(sums.shape)
            count += added
            means = sums / count
            half = quantile * stats.sem(means, axis=1)
            stops = running & (half <= goal)
            covered[stops] = np.abs(means.mean(axis=1)[stops]) <= half[stops]
            running &= ~stops
        assert covered.mean() > 0.95 - 3 * 0.0015


def test_the_plain_quantile_would_break_it() -> None:
    """Looks with independent spreads, stopped as soon as the plain interval is short enough: below 93.5 %."""
    generator = np.random.default_rng(4)
    degrees, runs = 7, 20_000
    covered = {}
    for name, quantile in (
        ("plain", float(stats.t.ppf(0.975, degrees))),
        ("sequential", sequential_quantile(0.95, degrees)),
    ):
        held, running, spread = np.zeros(runs, bool), np.ones(runs, bool), 1.0
        while running.any():
            half = quantile * spread * np.sqrt(generator.chisquare(degrees, runs) / degrees)
            stops = running & (half <= 0.25)
            held[stops] = np.abs(spread * generator.standard_normal(runs))[stops] <= half[stops]
            running &= ~stops
            spread /= np.sqrt(2)
        covered[name] = held.mean()
    assert covered["plain"] < 0.935
    assert covered["sequential"] > 0.95 - 3 * 0.0015
