"""Distributions and directions against SciPy and exact solid angles, and the frozen distributions of SciPy as warps."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from evenlight import points, warp


def test_quantiles_are_those_of_scipy() -> None:
    u = np.concatenate([points.Independent(1, seed=1).points(0, 5000)[:, 0], 2.0 ** -np.arange(2, 54)])
    x = warp.Gaussian().map(u[:, None])[:, 0]
    half = 2.0**-54  # of the interval that a number stands for; near 1 it would be lost in a sum
    expected = np.where(u < 0.5, special.ndtri(u + half), -special.ndtri(1 - u - half))
    assert (abs(x - expected) <= 4e-15 * np.maximum(abs(expected), 0.1)).all()
    np.testing.assert_allclose(warp.Gaussian().invert(x[:, None])[:, 0], special.ndtr(x), rtol=0, atol=1e-15)
    np.testing.assert_allclose(warp.Gaussian().density(x[:, None]), stats.norm.pdf(x), rtol=1e-13)


@pytest.mark.parametrize(
    "distribution",
    [
        stats.expon(scale=2.0),
        stats.beta(2.0, 3.0),
        stats.t(4),
        stats.gamma(2.5),
        stats.uniform(-1.0, 5.0),
        stats.norm(2, 3),
    ],
    ids=lambda distribution: distribution.dist.name,
)
def test_frozen_distributions_are_warps(distribution: Any) -> None:
    """The Kolmogorov-Smirnov distance of 1024 scrambled points is below 2/1024, as any (0, 10, 1)-net's."""
    frozen = warp.Frozen(distribution)
    u = points.Sobol(1, seed=3).points(0, 1024)
    x = frozen.map(u)
    assert np.isfinite(frozen.map([[0.0], [1 - 2**-53]])).all()
    np.testing.assert_allclose(frozen.invert(x), u, rtol=0, atol=1e-12)
    np.testing.assert_allclose(frozen.density(x), distribution.pdf(x[:, 0]))
    assert stats.kstest(x[:, 0], distribution.cdf).statistic <= 2 / 1024


def test_independent_frozen_distributions_multiply() -> None:
    frozen = warp.Frozen(stats.poisson(3.0), stats.expon())
    assert (frozen.inputs, frozen.outputs, repr(frozen)) == (2, 2, "Frozen(poisson, expon)")
    x = frozen.map(points.Sobol(2, seed=3).points(0, 4096).reshape(64, 64, 2))
    assert x.shape == (64, 64, 2)
    np.testing.assert_allclose(x.mean(axis=(0, 1)), [3, 1], atol=0.01)
    np.testing.assert_allclose(frozen.density(x), stats.poisson(3).pmf(x[..., 0]) * stats.expon.pdf(x[..., 1]))
    np.testing.assert_array_equal(frozen.map(frozen.invert(x) * (1 - 1e-12))[..., 0], x[..., 0])


def test_choices_have_their_shares() -> None:
    """With n stratified numbers, inversion gives every choice its share up to two points; tables have 37 columns."""
    weights = points.Independent(1, seed=9).points(0, 37)[:, 0]
    u = points.Sobol(1, seed=3).points(0, 1024)
    share = 1024 * weights / weights.sum()
    counts = np.bincount(warp.Discrete(weights).map(u)[:, 0].astype(int), minlength=37)
    assert abs(counts - share).max() < 2
    tables = np.bincount(warp.DiscreteAlias(weights).map(u)[:, 0].astype(int), minlength=37)
    assert tables.sum() == 1024
    assert abs(tables - share).max() < 37


def test_solid_angles_are_exact() -> None:
    face = warp.SphericalRectangle([[-1, -1, 1], [1, -1, 1], [-1, 1, 1]])
    assert face.density([0.0, 0.0, 1.0]) == pytest.approx(6 / (4 * math.pi), rel=1e-14)
    octant = warp.SphericalTriangle(np.eye(3))
    assert octant.density([0.6, 0.0, 0.8]) == pytest.approx(2 / math.pi, rel=1e-14)
    # a square of side h at distance 1 is seen with h^2 (1 - h^2 / 4) and less
    tiny = warp.SphericalRectangle([[-5e-5, -5e-5, 1], [5e-5, -5e-5, 1], [-5e-5, 5e-5, 1]])
    assert tiny.density([0.0, 0.0, 1.0]) == pytest.approx(1e8, rel=1e-8)
    u = points.Independent(2, seed=2).points(0, 1000)
    small = warp.SphericalTriangle([[0, 0, 1], [1e-4, 0, 1], [0, 1e-4, 1]])
    assert abs(small.invert(small.map(u)) - u).max() < 1e-8


def test_images_draw_environment_maps() -> None:
    """A map by latitude with rows times sin(theta): means of mapped points are means over directions."""
    height, width = 32, 64
    theta = (np.arange(height) + 0.5) * math.pi / height
    radiance = 1 + np.cos(theta)[:, None] * np.ones(width)
    x = warp.Image(radiance * np.sin(theta)[:, None]).map(points.Sobol(2, seed=1).points(0, 2**14))
    expected = (radiance[:, 0] * np.sin(theta) * np.cos(theta)).sum() / (radiance[:, 0] * np.sin(theta)).sum()
    assert np.cos(x[:, 1] * math.pi).mean() == pytest.approx(expected, abs=2e-3)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: warp.Cap(0.0), "option 'angle' of warp 'cap' must be above 0 and at most π, not 0.0"),
        (lambda: warp.Torus(1.0, 2.0), "option 'tube' of warp 'torus' must be at most the radius, not 2.0"),
        (lambda: warp.Cylinder(-1.0), "option 'radius' of warp 'cylinder' must be positive"),
        (
            lambda: warp.Discrete([1.0, -2.0]),
            "values' of warp 'discrete' must be finite numbers from 0 on .* not -2 at 1",
        ),
        (lambda: warp.Discrete([0.0, 0.0]), "with a positive sum, not 2 with sum 0"),
        (lambda: warp.PiecewiseLinear([1.0, 2.0], [0.0, 0.0]), "must be ascending finite numbers"),
        (lambda: warp.PiecewiseLinear([1.0]), "at least two numbers"),
        (lambda: warp.Image([1.0, 2.0]), r"values must have shape \(\*, \*\)"),
        (lambda: warp.SphericalTriangle([[1, 0, 0], [0, 1, 0], [1, 1, 0]]), "not in one plane with the origin"),
        (lambda: warp.SphericalRectangle([[0, 0, 1], [1, 0, 1], [1, 1, 1]]), "at a right angle"),
        (lambda: warp.Simplex(65), "dims must be from 1 to 64, not 65"),
        (lambda: warp.Frozen(), "at least one frozen distribution"),
        (lambda: warp.Frozen(stats.norm()).map([[1.0]]), r"u must be in \[0, 1\)"),
    ],
)
def test_mistakes_are_named(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()  # type: ignore[operator]


def test_frozen_distributions_are_of_scipy() -> None:
    with pytest.raises(TypeError, match=r"a frozen distribution of scipy.stats is needed, not float"):
        warp.Frozen(1.0)
