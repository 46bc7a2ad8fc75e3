"""Diffusion with random coefficients: known solutions, quadrature of the mean, order of meshes, mixed differences."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import integrate
from scipy.special import ndtr

from evenlight.multilevel.models import (
    FIELDS,
    Diffusion1D,
    Diffusion2D,
    IndexedDiffusion1D,
    IndexedDiffusion2D,
    LogNormalField,
    UniformField,
)
from evenlight.multilevel.models.five_point import mean_solutions
from level_moments import exponent, moments

Array = NDArray[np.float64]

# The integral of the solution of -Δv = 1 on the unit square: Saint-Venant's series.
TORSION = 1 / 12 - 16 / math.pi**5 * sum(math.tanh(k * math.pi / 2) / k**5 for k in range(1, 60, 2))


class Constant:
    """A medium that is 1 + u everywhere."""

    terms = 1

    def values(self, u: Array, *places: Array) -> Array:
        """The same at all places."""
        return np.asarray((1.0 + u) * np.ones((1, len(places[0]))))


class Exponential:
    """exp(x + y / 2), for which a solution can be made."""

    terms = 1

    def values(self, u: Array, *places: Array) -> Array:
        """The same for all numbers."""
        return np.asarray(np.exp(places[0] + (places[1] / 2 if len(places) > 1 else 0.0)) * np.ones((len(u), 1)))


@pytest.mark.parametrize(("model", "integral"), [(Diffusion1D, 1 / 12), (Diffusion2D, TORSION / 2)])
def test_a_constant_medium(model: Any, integral: float) -> None:
    """The mean of 1 / (1 + u) is log 2. Meshes of 2^-k: errors fall by 4, and what is left is a third of the last."""
    exact = math.log(2.0) * (integral if model is Diffusion1D else TORSION)
    nodes, weights = np.polynomial.legendre.leggauss(12)
    u = (nodes[:, np.newaxis] + 1.0) / 2.0
    values = [float(weights @ model(Constant()).sample(level, u).fine / 2.0) for level in (1, 2, 3)]
    assert (values[2] - values[1]) / (values[1] - values[0]) == pytest.approx(0.25, rel=0.1)
    assert values[2] + (values[2] - values[1]) / 3 == pytest.approx(exact, rel=2e-3)


def test_one_dimension_against_the_formula() -> None:
    """u(x) = ∫ (c - s) / a(s) ds: both integrals by quadrature, for one medium of each kind."""
    u = np.random.default_rng(1).random((1, 8))
    for field in (LogNormalField(), UniformField()):

        def resistance(x: float, field: Any = field) -> float:
            return float(1.0 / field.values(u, np.array([x]))[0, 0])

        whole = integrate.quad(resistance, 0, 1, epsabs=1e-10)[0]
        c = integrate.quad(lambda s: s * resistance(s), 0, 1, epsabs=1e-10)[0] / whole
        exact = integrate.quad(lambda s, c=c: (1 - s) * (c - s) * resistance(s), 0, 1, epsabs=1e-10)[0]
        fine = Diffusion1D(field).sample(6, u).fine[0]
        finer = Diffusion1D(field).sample(7, u).fine[0]
        assert finer + (finer - fine) / 3 == pytest.approx(exact, rel=1e-6)


def test_two_dimensions_against_an_independent_solver() -> None:
    """A medium that varies: a dense system, assembled edge by edge; and a mesh whose sides differ, both ways round."""
    field = LogNormalField(5)
    u = np.random.default_rng(2).random((3, 5))
    for nx, ny in ((6, 6), (7, 3), (3, 7), (2, 5), (2, 2), (18, 17)):
        assert mean_solutions(field, u, (nx, ny)) == pytest.approx(
            [_dense(field, row[np.newaxis], nx, ny) for row in u], rel=1e-12
        )


def _dense(field: Any, u: Array, nx: int, ny: int) -> float:
    size = (nx + 1) * (ny + 1)
    matrix = np.zeros((size, size))

    def link(i: int, j: int, k: int, m: int) -> None:
        a = field.values(u, np.array([(i + k) / 2 / nx]), np.array([(j + m) / 2 / ny]))[0, 0]
        a *= nx * nx if i != k else ny * ny
        p, q = i * (ny + 1) + j, k * (ny + 1) + m
        matrix[[p, q], [p, q]] += a
        matrix[[p, q], [q, p]] -= a

    for i in range(nx + 1):
        for j in range(ny + 1):
            if i < nx:
                link(i, j, i + 1, j)
            if j < ny:
                link(i, j, i, j + 1)
    inner = np.array([i * (ny + 1) + j for i in range(1, nx) for j in range(1, ny)])
    return float(np.linalg.solve(matrix[np.ix_(inner, inner)], np.ones(len(inner))).sum() / (nx * ny))


def test_the_mesh_has_order_two_in_a_medium_that_varies() -> None:
    """Differences of meshes of 8, 16, 32, 64 cells for a = exp(x + y / 2)."""
    means = np.array([mean_solutions(Exponential(), np.zeros((1, 1)), (m, m))[0] for m in (8, 16, 32, 64)])
    ratios = np.diff(means)[:-1] / np.diff(means)[1:]
    assert ratios == pytest.approx(4.0, rel=0.05)


def test_the_expansion_has_the_covariance_it_is_of() -> None:
    """What terms beyond the 400th leave out of the variance is 2 / (π² ℓ 400), half a percent at the most."""
    x = np.linspace(0.0, 1.0, 9)
    field = LogNormalField(400, length=0.4)
    modes = field._modes(x)
    assert modes.T @ modes == pytest.approx(np.exp(-np.abs(x[:, np.newaxis] - x) / 0.4), abs=5e-3)
    fine = (np.arange(20_000) + 0.5) / 20_000
    first = LogNormalField(6)._modes(fine)
    gram = first @ first.T / 20_000
    assert gram == pytest.approx(np.diag(np.diag(gram)), abs=1e-6)


def test_the_mean_of_a_log_normal_medium() -> None:
    """Two terms, by Gauss and Hermite's rule, against independent samples on the same mesh: 4 sigma, 1 in 16,000."""
    model = Diffusion1D(LogNormalField(2, sigma=0.8))
    nodes, weights = np.polynomial.hermite_e.hermegauss(20)
    grid = np.stack(np.meshgrid(ndtr(nodes), ndtr(nodes), indexing="ij"), axis=-1).reshape(-1, 2)
    exact = np.outer(weights, weights).ravel() @ model.sample(3, np.minimum(grid, 1 - 2.0**-53)).fine / (2 * math.pi)
    values = model.sample(3, np.random.default_rng(1).random((40_000, 2))).fine
    assert abs(values.mean() - exact) <= 4 * values.std() / 200


@pytest.mark.parametrize("name", FIELDS)
def test_variances_fall_by_sixteen_in_smooth_media(name: str) -> None:
    """Seeds move the fit by 0.1 at the most; log-normal media are still rough for the first meshes."""
    _, one = moments(Diffusion1D(name), 7, 2000, seed=1)
    _, two = moments(Diffusion2D(name, first_cells=2), 5, 300, seed=1)
    assert exponent(one, first=3) == pytest.approx(4.0, abs=0.35)
    assert exponent(two) == pytest.approx(4.0, abs=0.5)


def test_mixed_differences_fall_in_both_directions() -> None:
    u = np.random.default_rng(1).random((100, 8))
    model = IndexedDiffusion2D("uniform")

    def size(level: tuple[int, int]) -> float:
        return float(np.abs(model.sample(level, u[:, : model.dims(level)]).difference).mean())

    assert size((2, 2)) / size((3, 2)) == pytest.approx(4.0, rel=0.15)
    assert size((2, 2)) / size((2, 3)) == pytest.approx(4.0, rel=0.15)
    assert size((2, 2)) / size((3, 3)) == pytest.approx(16.0, rel=0.25)


@pytest.mark.parametrize("model", [IndexedDiffusion1D("uniform"), IndexedDiffusion2D("log_normal", first_cells=2)])
def test_mixed_differences_add_up(model: Any) -> None:
    """All pairs of levels together, from the same numbers, are the value of the finest pair."""
    last = (3, 2)
    u = np.random.default_rng(1).random((20, model.dims(last)))
    pairs = [(i, j) for i in range(4) for j in range(3)]
    total = sum(model.sample(pair, u[:, : model.dims(pair)]).difference for pair in pairs)
    assert total == pytest.approx(model.sample(last, u).fine, rel=1e-12)
    coupled = model.sample(last, u)
    assert coupled.cost == pytest.approx(20 * model.cost(last))
    assert model.cost((0, 0)) < model.cost((1, 0)) < model.cost((1, 1))
