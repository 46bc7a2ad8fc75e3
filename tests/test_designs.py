"""Designs and generators from outside: what the first call decides, NumPy's numbers, refusals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.stats import qmc

from evenlight import points
from evenlight.points import (
    CorrelatedMultiJittered,
    Dyadic,
    LatinHypercube,
    MersenneTwister,
    OrthogonalArray,
    Pcg,
    Philox,
    ProgressiveMultiJittered,
    Stratified,
)

MASK = 2**64 - 1
GOLDEN_RATIO = 0x9E37_79B9_7F4A_7C15


def mix(x: int) -> int:
    """The finalizer of SplitMix64, which seeds are hashed with."""
    x = (x ^ x >> 30) * 0xBF58_476D_1CE4_E5B9 & MASK
    x = (x ^ x >> 27) * 0x94D0_49BB_1331_11EB & MASK
    return x ^ x >> 31


def split(seed: int, tag: int, number: int) -> int:
    """Child `number` of kind `tag` of a seed."""
    return mix(mix(seed + tag & MASK) + number * GOLDEN_RATIO & MASK)


def column(seed: int, dim: int) -> int:
    """The seed of a coordinate."""
    return split(mix(seed + GOLDEN_RATIO & MASK), 2, dim)


@pytest.mark.parametrize("dim", [0, 1, 4])
def test_generators_draw_what_numpy_draws(dim: int) -> None:
    word = column(7, dim)
    twister = np.random.RandomState([word & 0xFFFF_FFFF, word >> 32]).random_sample(2000)
    np.testing.assert_array_equal(MersenneTwister(5, seed=7).random(2000)[:, dim], twister)

    key = np.array([split(word, 0, 0), split(word, 0, 1)], dtype=np.uint64)
    philox = np.random.Generator(np.random.Philox(key=key)).random(2000)
    np.testing.assert_array_equal(Philox(5, seed=7).random(2000)[:, dim], philox)

    first, second, third, fourth = (split(word, 0, number) for number in range(4))
    increment = ((third << 64 | fourth) << 1 | 1) % 2**128
    state = ((first << 64 | second) + increment) * 0x2360ED051FC65DA44385DF649FCCF645 + increment
    bits = np.random.PCG64()
    bits.state = {**bits.state, "state": {"state": state % 2**128, "inc": increment}}
    np.testing.assert_array_equal(Pcg(5, seed=7).random(2000)[:, dim], np.random.Generator(bits).random(2000))


def test_a_twister_goes_back_and_forth() -> None:
    twister = MersenneTwister(3, n=10_000, seed=1)
    everything = twister.points(0, 10_000)
    for start, stop in [(9_000, 9_010), (5, 7), (7, 400), (0, 1)]:
        np.testing.assert_array_equal(twister.points(start, stop), everything[start:stop])


def test_the_first_call_says_how_many_points_there_are() -> None:
    hypercube = LatinHypercube(2, seed=3)
    counts = [hypercube.n]
    with pytest.raises(ValueError, match=r"must know its number of points: LatinHypercube\(2, n=\.\.\.\)"):
        hypercube.points(0, 4)
    drawn = hypercube.random(10)
    assert [*counts, hypercube.n] == [None, 10]
    np.testing.assert_array_equal(drawn, LatinHypercube(2, n=10, seed=3).points(0, 10))
    with pytest.raises(ValueError, match="has 10 points"):
        hypercube.random(1)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (
            lambda: Stratified(2).random(50),
            "'stratified' must be the 2th power of a whole number, such as 49 or 64, not 50",
        ),
        (lambda: OrthogonalArray(5).random(36), "p\\^2 for a prime p of at least d - 1 = 4, such as 25 or 49, not 36"),
        (lambda: OrthogonalArray(9).random(25), "at least d - 1 = 8, such as 121, not 25"),
        (
            lambda: OrthogonalArray(3, strength=3).random(9),
            "p\\^3 for a prime p of at least d - 1 = 2, such as 8 or 27",
        ),
        (
            lambda: OrthogonalArray(3, strength=4, n=81),
            "option 'strength' of sequence 'orthogonal_array' must be 2 or 3",
        ),
        (lambda: LatinHypercube(3, n=0), "a number of points from 1 to 2147483648, not 0"),
        (lambda: LatinHypercube(3, n=2**31 + 1), "a number of points from 1 to 2147483648, not 2147483649"),
        (lambda: ProgressiveMultiJittered(3, scramble="none"), "accepted: owen, owen_exact"),
    ],
)
def test_impossible_designs_are_refused(build: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        build()


def test_designs_are_as_even_as_scipy_finds_them() -> None:
    independent = qmc.discrepancy(points.Independent(2, seed=1).random(1024))
    for design in [Stratified, points.MultiJittered, CorrelatedMultiJittered, Dyadic, points.Sz]:
        assert qmc.discrepancy(design(2, seed=1).random(1024)) < 0.2 * independent, design


def test_scipys_hypercubes_have_the_same_error() -> None:
    """Stein (1987): for a sum, one point in each slice leaves d / (12 n^3). 1,000 squares, six deviations."""
    ours, theirs = [], []
    for seed in range(1_000):
        ours.append(LatinHypercube(3, seed=seed).random(20).sum(axis=1).mean() - 1.5)
        theirs.append(qmc.LatinHypercube(3, rng=seed).random(20).sum(axis=1).mean() - 1.5)
    for errors in ours, theirs:
        assert 12 * 20**3 / 3 * np.mean(np.square(errors)) == pytest.approx(1, abs=6 * np.sqrt(2 / 1_000))
