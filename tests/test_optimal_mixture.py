"""Optimal mixture weights: known optima, derivatives, certificates, and an independent solver."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import optimize, stats

from evenlight.importance import optimal_mixture
from evenlight.importance.active_set import minimize_quadratic
from evenlight.importance.mixture_objective import Face, Pilot, certificate


def random_pilot(seed: int, n: int = 400, components: int = 12) -> Pilot:
    generator = np.random.default_rng(seed)
    q = generator.exponential(size=(n, components)) ** 2
    floors = np.full(components, 0.1 / components)
    return Pilot(generator.normal(size=n) ** 3, q, q.mean(axis=1), floors, q @ floors)


def toy() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """1{x > 3} under N(0, 1) with N(0, 1), N(3, 1), N(-3, 1); Gauss's rule in two panels as the pilot sample."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    x = np.concatenate([-6 + 9 * nodes, 9 + 6 * nodes])
    w = np.concatenate([9 * weights, 6 * weights])
    q = np.stack([stats.norm.pdf(x, mean) for mean in (0, 3, -3)], axis=1)
    return (x > 3) * q[:, 0], q, 1 / (len(x) * w)


def test_the_smallest_case_has_the_known_optimum() -> None:
    found = optimal_mixture([1.0], [[2.0, 3.0]], [1.0], floor=0.005, control_variates=False)
    assert found.variance + 1 == pytest.approx(0.333890, rel=1e-5)  # 1 / (2 * 0.005 + 3 * 0.995)
    np.testing.assert_allclose(found.alpha, [0.005, 0.995], rtol=1e-9)


def test_the_toy_has_the_optima_of_quadrature() -> None:
    alone = optimal_mixture(*toy(), floor=1 / 30, control_variates=False, gap=1e-9)
    np.testing.assert_allclose(alone.alpha, [1 / 30, 14 / 15, 1 / 30], atol=1e-9)
    assert alone.variance == pytest.approx(6.740910e-6, rel=1e-5)
    assert alone.beta is None
    joint = optimal_mixture(*toy(), floor=1 / 30, control_variates="joint", gap=1e-9)
    assert joint.variance == pytest.approx(6.567632e-6, rel=1e-5)
    then = optimal_mixture(*toy(), floor=1 / 30, gap=1e-9)
    assert joint.variance <= then.variance * (1 + 1e-9) <= alone.variance * (1 + 1e-9)


@pytest.mark.parametrize("with_beta", [False, True])
def test_derivatives_are_those_of_differences(with_beta: bool) -> None:
    pilot = random_pilot(1)
    chosen = np.array([0, 3, 4, 7])
    face = Face(pilot, chosen, with_beta)
    a = np.array([0.3, 0.2, 0.25, 0.15])
    _, gradient, hessian = face.derivatives(a)
    step = 1e-5 * np.eye(4)
    slopes = [(face.value(a + h) - face.value(a - h)) / 2e-5 for h in step]
    np.testing.assert_allclose(gradient, slopes, rtol=1e-6)
    rows = [(face.derivatives(a + h)[1] - face.derivatives(a - h)[1]) / 2e-5 for h in step]
    np.testing.assert_allclose(hessian, rows, rtol=1e-5, atol=1e-7 * np.abs(hessian).max())


def test_the_second_moment_is_convex_everywhere() -> None:
    generator = np.random.default_rng(2)
    for seed in range(100):
        pilot = random_pilot(seed, n=60, components=5)
        face = Face(pilot, np.arange(5), with_beta=bool(seed % 2))
        for _ in range(10):
            hessian = face.derivatives(generator.dirichlet(np.ones(5)) * pilot.mass)[2]
            assert np.linalg.eigvalsh(hessian)[0] >= -1e-10 * np.trace(hessian)


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("joint", [False, True])
def test_no_weights_are_better_than_the_certificate_allows(seed: int, joint: bool) -> None:
    """A thousand random weights, and the general solver of SciPy, against the lower bound."""
    pilot = random_pilot(seed)
    face = Face(pilot, np.arange(12), joint)
    found = optimal_mixture(pilot.fp, pilot.q, pilot.density, control_variates="joint" if joint else False, gap=1e-6)
    best = face.value(found.alpha - pilot.floors)
    assert found.gap <= 1e-6
    assert (found.alpha >= pilot.floors * (1 - 1e-9)).all()
    assert found.alpha.sum() == pytest.approx(1.0)
    for weights in np.random.default_rng(seed).dirichlet(np.full(12, 0.3), size=200):
        assert face.value(weights * pilot.mass) >= (1 - found.gap) * best
    rival = optimize.minimize(  # type: ignore[call-overload]
        face.value,
        np.full(12, pilot.mass / 12),
        jac=lambda a: face.derivatives(a)[1],
        bounds=[(0, None)] * 12,
        constraints={"type": "eq", "fun": lambda a: a.sum() - pilot.mass, "jac": lambda a: np.ones(12)},
        method="SLSQP",
        options={"ftol": 1e-14, "maxiter": 300},
    )
    assert best <= rival.fun * (1 + 1e-6)


def test_a_bad_point_has_an_honest_gap() -> None:
    pilot = random_pilot(3)
    t = pilot.q @ np.full(12, 1 / 12)
    value, _, gap = certificate(pilot, pilot.fp, t)
    best = optimal_mixture(pilot.fp, pilot.q, pilot.density, control_variates=False, gap=1e-8)
    second = best.variance + np.mean(pilot.fp / pilot.density) ** 2
    assert second >= (1 - gap) * value
    assert gap > 1 - second / value - 1e-8


def test_quadratics_on_the_simplex_have_their_known_minimum() -> None:
    """The nearest point of the simplex: sorted differences, cut off where they reach the floor."""
    generator = np.random.default_rng(5)
    for _ in range(50):
        target = generator.normal(size=9)
        start = np.full(9, 1 / 9)
        ordered = np.sort(target)[::-1]
        shifts = (np.cumsum(ordered) - 1) / np.arange(1, 10)
        shift = shifts[np.flatnonzero(ordered > shifts)[-1]]
        found = minimize_quadratic(start - target, np.eye(9), start)
        np.testing.assert_allclose(found, np.maximum(target - shift, 0), atol=1e-9)


def test_a_common_factor_of_a_row_changes_nothing() -> None:
    pilot = random_pilot(4)
    factor = np.random.default_rng(4).exponential(size=len(pilot.fp)) * 1e-30
    one = optimal_mixture(pilot.fp, pilot.q, pilot.density)
    other = optimal_mixture(pilot.fp * factor, pilot.q * factor[:, np.newaxis], pilot.density * factor)
    np.testing.assert_allclose(one.alpha, other.alpha, atol=1e-8)
    assert one.variance == pytest.approx(other.variance, rel=1e-8)


def test_small_values_are_optimized_as_well_as_large_ones() -> None:
    pilot = random_pilot(4)
    for factor in (1e-9, 1e9):
        found = optimal_mixture(pilot.fp * factor, pilot.q, pilot.density, gap=1e-8)
        np.testing.assert_allclose(found.alpha, optimal_mixture(*pilot[:3], gap=1e-8).alpha, atol=1e-6)


def test_hundreds_of_components_are_certified() -> None:
    pilot = random_pilot(6, n=3000, components=400)
    found = optimal_mixture(pilot.fp, pilot.q, pilot.density, control_variates=False, gap=1e-6)
    assert found.gap <= 1e-6


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([1.0], [[1.0, 1.0]], [0.0]), "above 0"),
        (([1.0], [[1.0, -1.0]], [1.0]), "not negative"),
        (([1.0, 2.0], [[1.0, 1.0]], [1.0]), r"not \(n,\), \(n, J\), \(n,\)"),
        (([0.0], [[1.0, 1.0]], [1.0]), "nothing to learn from"),
    ],
)
def test_samples_without_meaning_are_refused(arguments: tuple[object, object, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        optimal_mixture(*arguments)
