"""Triangles, nets, boxes anywhere and spectra from Python: known values, and shapes of any kind."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from evenlight import points, quality, warp

Array = npt.NDArray[np.float64]

DISKS: Any = "disks"


@pytest.mark.parametrize("corners", [np.eye(3), [[0, 0], [1, 0], [0, 1]], [[3, 1, 4, 1], [5, 9, 2, 6], [-5, 3, 5, 8]]])
def test_the_discrepancy_of_a_triangle_does_not_depend_on_its_shape(corners: Any) -> None:
    n = 64
    barycentric = np.random.default_rng(2).dirichlet([1, 1, 1], n)
    x = barycentric @ np.asarray(corners, dtype=np.float64)
    for sets in ("parallelograms", "trapezoids"):
        wanted = quality.triangle_discrepancy(barycentric, np.eye(3), sets=sets)
        assert quality.triangle_discrepancy(x, corners, sets=sets) == pytest.approx(wanted, abs=1e-12)
    order = [2, 0, 1]
    assert quality.triangle_discrepancy(x, np.asarray(corners)[order]) == pytest.approx(
        quality.triangle_discrepancy(x, corners), abs=1e-12
    )


def parallelograms_by_definition(x: Array) -> float:
    """The parallelogram discrepancy of barycentric points by counting for every pair of bounds."""
    worst = 0.0
    for first, second in [(1, 2), (2, 0), (0, 1)]:
        a, b = np.round(x[:, first], 13), np.round(x[:, second], 13)
        s, t = np.append(np.unique(a), 1.0), np.append(np.unique(b), 1.0)
        area = 2 * s[:, None] * t - np.maximum(s[:, None] + t - 1, 0) ** 2
        below = (a < s[:, None]).astype(float) @ (b < t[:, None]).T.astype(float)
        up_to = (a <= s[:, None]).astype(float) @ (b <= t[:, None]).T.astype(float)
        worst = max(worst, (area - below / len(x)).max(), (up_to / len(x) - area).max())
    return worst


@pytest.mark.parametrize("n", [1, 7, 100])
def test_the_discrepancy_of_a_triangle_is_that_of_counting(n: int) -> None:
    for x in (np.random.default_rng(n).dirichlet([1, 1, 1], n), warp.triangle_van_der_corput(n, np.eye(3))):
        assert quality.triangle_discrepancy(x, np.eye(3)) == pytest.approx(parallelograms_by_definition(x), abs=1e-9)


def test_a_grid_of_four_in_a_triangle_has_the_known_discrepancy() -> None:
    x = np.array([[4, 4, 4], [8, 2, 2], [2, 8, 2], [2, 2, 8]]) / 12
    assert quality.triangle_discrepancy(x, np.eye(3)) == pytest.approx(2 / (3 * 2) - 1 / 36, abs=1e-12)


def test_gains_of_a_net_of_two_points() -> None:
    gains = quality.gain_coefficients([[0.0, 0.0], [0.5, 0.5]], [0, 1], levels=2)
    # Σ over pairs of Π (2·same finer − same): two points that share no half
    assert gains.tolist() == [[2.0, 1.0], [1.0, 1.0]]
    x = points.Sobol(3).points(0, 16)
    for u in ([0], [1, 2], [0, 1, 2]):
        assert quality.gain_coefficients(x, u).shape == (4,) * len(u)
        same = points.Sobol(3, seed=8).points(0, 16)
        assert (quality.gain_coefficients(x, u) == quality.gain_coefficients(same, u)).all()


def test_the_closest_pair_is_that_of_a_plain_search() -> None:
    x = np.random.default_rng(4).random((200, 3))
    difference = np.abs(x[:, None] - x[None])
    for torus in (True, False):
        gap = np.minimum(difference, 1 - difference) if torus else difference
        distance = np.sqrt((gap**2).sum(axis=-1)) + 9 * np.eye(len(x))
        assert quality.minimum_distance(x, torus=torus) == pytest.approx(distance.min(), rel=1e-12)
    assert quality.minimum_distance([[0.0, 1.0], [1.0, 0.0]]) == 0


def test_the_periodogram_is_its_definition_and_has_the_known_means() -> None:
    generator = np.random.default_rng(6)
    x = generator.random((37, 2))
    power = quality.periodogram(x, 5)
    for i, j in [(0, 0), (3, 7), (5, 5), (10, 2)]:
        wave = np.exp(-2j * np.pi * (x @ [i - 5, j - 5]))
        assert power[i, j] == pytest.approx(abs(wave.sum()) ** 2 / 37, abs=1e-10)
    mean = np.mean([quality.radial_spectrum(generator.random((256, 2)), 32).power for _ in range(50)], axis=0)
    # power of independent points has mean and deviation 1; the first ring has 4 independent frequencies, 50 times
    assert (np.abs(mean - 1) < 5 / np.sqrt(50 * 4)).all()


def test_a_lattice_has_its_dual_lattice_as_spectrum_and_its_distances() -> None:
    i = np.arange(16)
    x = np.column_stack((np.repeat(i, 16), np.tile(i, 16))) / 16
    power = quality.periodogram(x, 20)
    peaks = np.argwhere(power > 1e-9) - 20
    assert {tuple(peak) for peak in peaks} == {(a, b) for a in (-16, 0, 16) for b in (-16, 0, 16)}
    correlation = quality.pair_correlation(x, 40, most=0.0625 * 1.25)
    # the only pairs so close are the four neighbors of each point at 1/16
    (at,) = np.flatnonzero(correlation.density)
    width = 0.0625 * 1.25 / 40
    assert abs(correlation.distance[at] - 0.0625) <= width
    edges = correlation.distance[at] + np.array([-0.5, 0.5]) * width
    pairs = correlation.density[at] * 256 * 255 * np.pi * np.diff(edges**2)[0]
    assert pairs == pytest.approx(4 * 256)


def test_boxes_anywhere() -> None:
    x = points.Halton(2).points(0, 60)
    empty = quality.dispersion(x)
    assert not ((x > empty.lower) & (x < empty.upper)).all(axis=1).any()
    assert empty.volume == pytest.approx(np.prod(empty.upper - empty.lower))
    worst = quality.extreme_discrepancy(x)
    inside = (x >= worst.lower) & (x <= worst.upper) if worst.closed else (x > worst.lower) & (x < worst.upper)
    local = inside.all(axis=1).mean() - np.prod(worst.upper - worst.lower)
    assert abs(local) == pytest.approx(worst.value)
    star = quality.star_discrepancy(x)
    assert star <= worst.value <= 4 * star


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: quality.triangle_discrepancy([[0.5, 0.6]], [[0, 0], [1, 0], [0, 1]]),
            "point 0 is not in the triangle",
        ),
        (lambda: quality.triangle_discrepancy([[0.5]], [[0], [1], [2]]), r"corners must have shape \(3, 2\)"),
        (lambda: quality.triangle_discrepancy([[0, 0]], [[0, 0], [1, 1], [2, 2]]), "must not be on a line"),
        (lambda: quality.triangle_discrepancy([[1, 1, 1]], np.eye(3)), "point 0 is not in the plane"),
        (
            lambda: quality.triangle_discrepancy([[0, 0]], [[0, 0], [1, 0], [0, 1]], sets=DISKS),
            "unknown sets 'disks'",
        ),
        (lambda: quality.smallest_t(np.zeros((5, 1))), "a power of 2 of points, not 5"),
        (lambda: quality.smallest_t(np.zeros((4, 1)), base=1), "a base must be at least 2"),
        (lambda: quality.gain_coefficients([[0.5]], [1]), "coordinates must be different numbers from 0 to 0"),
        (lambda: quality.gain_coefficients([[0.5]], [0], base=1), "base must be at least 2, not 1"),
        (lambda: quality.minimum_distance([[0.5]]), "at least two points"),
        (lambda: quality.minimum_distance([[0.5], [2.0]]), r"must be in \[0, 1\]"),
        (lambda: quality.periodogram([[0.5]]), r"shape \(n, 2\)"),
        (lambda: quality.pair_correlation([[0, 0], [0, 1]], most=0.6), r"most must be in \(0, 0.5\], not 0.6"),
        (lambda: quality.dispersion(points.Sobol(2).points(0, 512), limit=10), "more than 10 boxes"),
    ],
)
def test_what_has_no_meaning_is_refused(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
