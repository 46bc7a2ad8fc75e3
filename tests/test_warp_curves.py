"""Space-filling curves from outside: both ways, points along them, order of clouds, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from evenlight import points, warp

CURVES = ("hilbert", "morton", "gray")


@pytest.mark.parametrize("curve", CURVES)
@pytest.mark.parametrize(("dims", "bits"), [(1, 32), (2, 32), (3, 21), (4, 16), (5, 12), (32, 2), (2, 3)])
def test_indices_and_cells_are_inverse(curve: str, dims: int, bits: int) -> None:
    index = np.random.default_rng(5).integers(0, 2 ** (dims * bits), 1000, dtype=np.uint64, endpoint=False)
    cells = warp.curve_cells(index, dims, bits, curve)
    assert cells.shape == (1000, dims)
    assert int(cells.max()) < 2**bits
    np.testing.assert_array_equal(warp.curve_index(cells, bits, curve), index)


def test_the_hilbert_curve_steps_to_neighbors_far_along() -> None:
    for dims, bits in [(2, 32), (3, 21), (7, 9)]:
        index = np.uint64(2 ** (dims * bits - 1) - 2500) + np.arange(5000, dtype=np.uint64)
        steps = np.abs(np.diff(warp.curve_cells(index, dims, bits).astype(np.int64), axis=0))
        np.testing.assert_array_equal(steps.sum(axis=1), 1)


@pytest.mark.parametrize("dims", [1, 2, 3, 5, 8, 13, 17, 32])
def test_numbers_survive_the_curve(dims: int) -> None:
    t = np.append(points.Independent(1, seed=dims).points(0, 2000)[:, 0], [0, 1 - 2**-53])
    x = warp.hilbert(t, dims)
    assert x.shape == (2002, dims)
    assert abs(warp.hilbert_inverse(x) - t).max() <= 1e-12
    single = t[:-1].astype(np.float32)
    assert warp.hilbert(single, dims).dtype == np.float32
    assert abs(warp.hilbert_inverse(warp.hilbert(single, dims)) - single).max() <= 1e-6


def test_the_curve_is_hoelder_continuous() -> None:
    """|H(x) - H(y)| <= 2 sqrt(d + 3) |x - y|^(1/d): He & Owen 2016."""
    rng = np.random.default_rng(8)
    for dims in (2, 3, 4):
        t = rng.random(20_000) * 0.9
        gap = 10.0 ** rng.uniform(-8, -1, t.size)
        distance = np.linalg.norm(warp.hilbert(t + gap, dims) - warp.hilbert(t, dims), axis=1)
        assert (distance <= 2 * np.sqrt(dims + 3) * gap ** (1 / dims)).all()


@pytest.mark.parametrize("curve", CURVES)
@pytest.mark.parametrize("dims", [1, 2, 3, 6])
def test_clouds_are_sorted_by_their_numbers(curve: str, dims: int) -> None:
    x = points.Independent(dims, seed=4).points(0, 40_000)
    order = warp.curve_sort(x, curve, bounds=[[0] * dims, [1] * dims], workers=2)
    np.testing.assert_array_equal(np.sort(order), np.arange(len(x)))
    np.testing.assert_array_equal(order, warp.curve_sort(x, curve, bounds=[[0] * dims, [1] * dims]))
    if dims > 1:
        bits = min(64 // dims, 32)
        keys = warp.curve_index((x * 2**bits).astype(np.uint32), bits, curve)
        np.testing.assert_array_equal(order, np.argsort(keys, kind="stable"))


def test_the_box_of_the_cloud_is_the_default() -> None:
    x = points.Independent(2, seed=4).points(0, 500) * [3, 1e-6] - [7, 5]
    box = [x.min(axis=0), x.max(axis=0)]
    np.testing.assert_array_equal(warp.hilbert_sort(x), warp.hilbert_sort(x, bounds=box))
    flat = np.column_stack([x[:, 0], np.ones(500)])
    np.testing.assert_array_equal(np.sort(warp.hilbert_sort(flat)), np.arange(500))
    assert warp.hilbert_sort(np.empty((0, 3))).shape == (0,)


def test_sequences_go_on_and_strata_are_filled() -> None:
    for source in ("van_der_corput", "owen"):
        whole = warp.curve_points(100, 3, source=source, seed=2)
        np.testing.assert_array_equal(warp.curve_points(40, 3, source=source, seed=2, start=60), whole[60:])
    for n in (7, 100):
        x = warp.curve_points(n, 3, seed=9)
        np.testing.assert_array_equal(np.floor(warp.hilbert_inverse(x) * n), np.arange(n))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: warp.curve_cells([0], 2, 33), "bits must be from 1 to 32"),
        (lambda: warp.curve_cells([0], 3, 22), r"dims \* bits at most 64, not 3 and 22"),
        (lambda: warp.curve_cells([16], 2, 2), "index must be from 0 to 15, not from 16 to 16"),
        (lambda: warp.curve_cells([0], 2, 2, "peano"), "unknown curve 'peano'; known: hilbert, morton, gray"),
        (lambda: warp.curve_points(4, 2, start=1), "start must be 0 for source 'stratified'"),
        (lambda: warp.curve_points(4, 2, source="sobol"), "unknown source 'sobol'; known: centered, "),
        (lambda: warp.hilbert([1.0], 2), r"u must be in \[0, 1\)"),
        (lambda: warp.hilbert([0.5], 33), "dims must be from 1 to 32, not 33"),
        (lambda: warp.hilbert_sort([0.5]), r"x must have shape \(n, dims\)"),
        (lambda: warp.hilbert_sort([[np.nan, 0.5]]), "x must be finite"),
        (lambda: warp.hilbert_sort([[0.5, 0.5]], bounds=[[0, 0], [1, 0]]), "a lower corner below"),
    ],
)
def test_mistakes_are_named(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()  # type: ignore[operator]


def test_cells_are_integers() -> None:
    with pytest.raises(TypeError, match="cells must be integers, not float64"):
        warp.curve_index([[0.5, 0.5]], 4)
