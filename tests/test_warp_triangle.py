"""Points of triangles from outside: any corners, any start, exact answers, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evenlight import quality, warp

EYE = np.eye(3)
CORNERS = np.array([[0.0, 1.0, 2.0, 0.5], [3.0, -1.0, 2.0, 0.0], [1.0, 1.0, 0.0, 7.0]])


@pytest.mark.parametrize("k", range(1, 6))
def test_the_discrepancy_at_powers_of_four_is_exact(k: int) -> None:
    n = 4**k
    measured = quality.triangle_discrepancy(warp.triangle_van_der_corput(n, EYE), EYE)
    assert measured == pytest.approx(2 / (3 * math.sqrt(n)) - 1 / (9 * n), abs=1e-9)


@pytest.mark.parametrize(("n", "scaled"), [(2, 1.09994), (490, 1.12643), (1962, 1.14604)])
def test_the_worst_counts_are_as_documented(n: int, scaled: float) -> None:
    assert quality.triangle_discrepancy(warp.triangle_van_der_corput(n, EYE), EYE) * math.sqrt(n) == pytest.approx(
        scaled, abs=1e-5
    )


def test_the_lattice_is_as_good_as_published() -> None:
    """Basu & Owen 2015, recomputed: 0.0507, 0.0146, 0.00421 at 3 pi / 8, up to 20 % for the points on the last side."""
    for n, published in [(64, 0.0507), (256, 0.0146), (1024, 0.00421)]:
        assert quality.triangle_discrepancy(warp.triangle_kronecker(n, EYE), EYE) == pytest.approx(published, rel=0.2)


@pytest.mark.parametrize("scramble", [None, "owen", "digital_shift"])
def test_any_start_and_corners_give_the_same_points(scramble: str | None) -> None:
    whole = warp.triangle_van_der_corput(100, EYE, scramble=scramble, seed=5)
    part = warp.triangle_van_der_corput(30, CORNERS, start=40, scramble=scramble, seed=5)
    np.testing.assert_allclose(part, whole[40:70] @ CORNERS, atol=1e-14)
    np.testing.assert_allclose(whole.sum(axis=1), 1, atol=1e-15)
    late = warp.triangle_van_der_corput(4, EYE, start=2**64 - 4, scramble=scramble, seed=5)
    assert ((late >= 0) & (late <= 1)).all()


def test_scrambles_by_their_names() -> None:
    def draw(scramble: str | bool | None, seed: int = 0) -> np.ndarray:
        return warp.triangle_van_der_corput(16, EYE, scramble=scramble, seed=seed)

    np.testing.assert_array_equal(draw(None), draw(False))
    np.testing.assert_array_equal(draw(True, 3), draw("owen", 3))
    assert abs(draw("owen", 3) - draw("owen", 4)).max() > 0.01
    with pytest.raises(ValueError, match="does not accept scramble 'linear'; accepted: owen, digital_shift, none"):
        draw("linear")


def test_scrambled_points_are_uniform() -> None:
    """Mean 1/3 and variance 1/18 of each of 27 coordinates over seeds, within 4.5 sigma: 1 in 5000 runs is not."""
    draws = np.stack([warp.triangle_van_der_corput(9, EYE, scramble="owen", seed=seed) for seed in range(4000)])
    error = math.sqrt(1 / 18 / 4000)
    assert abs(draws.mean(axis=0) - 1 / 3).max() < 4.5 * error
    # the fourth central moment is 1/135
    assert abs(draws.var(axis=0) - 1 / 18).max() < 4.5 * math.sqrt((1 / 135 - 1 / 18**2) / 4000)


def test_a_product_of_one_triangle_is_balanced_as_the_sequence() -> None:
    corners = np.stack([EYE, EYE, EYE])
    x = warp.triangle_product(64, corners, seed=2)
    assert x.shape == (64, 3, 3)
    for factor in range(3):
        cells = np.sort(np.floor(warp.TriangleQuaternary().invert(x[:, factor])[:, 0] * 64))
        np.testing.assert_array_equal(cells, np.arange(64))
    np.testing.assert_array_equal(warp.triangle_product(10, corners, start=20, seed=2), x[20:30])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: warp.triangle_van_der_corput(4, np.eye(2)), r"corners must have shape \(3, \*\), not \(2, 2\)"),
        (lambda: warp.triangle_van_der_corput(-1, EYE), "n must be at least 0"),
        (lambda: warp.triangle_van_der_corput(2, EYE, start=2**64 - 1), r"start \+ n must be at most 2\^64"),
        (lambda: warp.triangle_van_der_corput(2, np.full((3, 2), np.inf)), "corners must be finite"),
        (lambda: warp.triangle_kronecker(4, EYE, angle=math.nan), "angle and shift must be finite"),
        (lambda: warp.triangle_product(4, EYE), r"corners must have shape \(\*, 3, \*\)"),
    ],
)
def test_mistakes_are_named(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()  # type: ignore[operator]


def test_counts_are_integers() -> None:
    with pytest.raises(TypeError, match="n must be an integer, not float"):
        warp.triangle_van_der_corput(4.0, EYE)  # type: ignore[arg-type]
