"""Dynamics: reversible, volumes kept or known, of second order, stable below 2; HMC on a narrow normal."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

from evenlight.mcmc import HMC, NUTS, Microcanonical, RandomWalk, run
from evenlight.mcmc.leapfrog import GradientState, Trajectory, gradient_state, leapfrog


def harmonic(x: Any) -> Any:
    return -0.5 * (x**2).sum(axis=1)


def minus(x: Any) -> Any:
    return -x


def quartic(x: Any) -> Any:
    return -0.25 * (x**4).sum(axis=1) - 0.5 * x[:, 0] * x[:, 1]


def quartic_gradient(x: Any) -> Any:
    return -(x**3) - 0.5 * x[:, ::-1]


def advance(q: Any, p: Any, steps: int, step_size: float, functions: Any, root: Any = None) -> Trajectory:
    log_density, gradient = functions
    state = gradient_state(log_density, gradient, np.atleast_2d(np.asarray(q, np.float64)))
    momentum = np.atleast_2d(np.asarray(p, np.float64))
    return leapfrog(state, momentum, np.full(len(momentum), steps), step_size, (log_density, gradient, root))


QUARTIC = (quartic, quartic_gradient)
HARMONIC = (harmonic, minus)
ROOT = np.linalg.cholesky([[1.0, 0.4], [0.4, 0.5]])


@pytest.mark.parametrize("root", [None, ROOT])
def test_leapfrog_is_reversible(root: Any) -> None:
    start = np.array([[0.7, -0.4]]), np.array([[0.3, 0.9]])
    end = advance(*start, 1000, 0.05, QUARTIC, root)
    back = advance(end.position, -end.momentum, 1000, 0.05, QUARTIC, root)
    np.testing.assert_allclose(back.position, start[0], atol=1e-12)
    np.testing.assert_allclose(-back.momentum, start[1], atol=1e-12)


def test_leapfrog_preserves_volume() -> None:
    """The determinant of the Jacobian, by the complex step: exact to rounding."""
    point = np.array([0.7, -0.4, 0.3, 0.9])
    position, momentum = (np.tile(part, (4, 1)).astype(complex) for part in (point[:2], point[2:]))
    position += 1e-30j * np.eye(4)[:, :2]
    momentum += 1e-30j * np.eye(4)[:, 2:]
    state = GradientState(position, np.zeros(4), quartic_gradient(position))
    complex_steps = np.full(4, 20)
    end = leapfrog(state, momentum, complex_steps, 0.1, (lambda x: np.zeros(len(x)), quartic_gradient, None))
    jacobian = np.concatenate([end.position, end.momentum], axis=1).imag / 1e-30
    assert np.linalg.det(jacobian) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize(("step_size", "largest"), [(0.1, 0.00125), (0.5, 0.03125), (1.0, 0.12)])
def test_the_shadow_of_the_energy_is_exactly_kept(step_size: float, largest: float) -> None:
    """p^2 / 2 + q^2 (1 - h^2 / 4) / 2 over 1,000 steps; the energy itself swings by a known amount."""
    lengths = np.arange(1, 1001)
    state = gradient_state(*HARMONIC, np.ones((1000, 1)))
    end = leapfrog(state, np.full((1000, 1), 0.3), lengths, step_size, (*HARMONIC, None))
    shadow = 0.5 * end.momentum**2 + 0.5 * end.position**2 * (1 - step_size**2 / 4)
    assert np.abs(shadow - (0.5 * 0.09 + 0.5 * (1 - step_size**2 / 4))).max() < 1e-12
    assert np.abs(end.energy_error).max() == pytest.approx(largest, rel=0.03)


def test_steps_beyond_two_deviations_blow_up_and_are_rejected() -> None:
    assert advance([[1.0]], [[0.3]], 200, 1.99, HARMONIC).energy_error[0] < 100
    assert advance([[1.0]], [[0.3]], 200, 2.05, HARMONIC).energy_error[0] > 1e6
    chains = run(HMC(quartic, quartic_gradient, step_size=3.0, steps=20), [1.0, 1.0], n=50, chains=20)
    assert np.isinf(chains.info["energy_error"]).any()
    assert np.isfinite(chains.kept_draws()).all()


def test_the_energy_error_is_of_second_order() -> None:
    """Half the step size, a quarter of the largest error over the same time."""
    largest = []
    for halvings in (0, 1):
        lengths = np.arange(1, 41) * 2**halvings
        state = gradient_state(*QUARTIC, np.tile([0.7, -0.4], (40, 1)))
        end = leapfrog(state, np.tile([0.3, 0.9], (40, 1)), lengths, 0.1 / 2**halvings, (*QUARTIC, None))
        largest.append(np.abs(end.energy_error).max())
    assert largest[0] / largest[1] == pytest.approx(4, abs=0.4)


def test_lengths_are_those_of_each_chain() -> None:
    together = leapfrog(
        gradient_state(*QUARTIC, np.ones((3, 2))), np.ones((3, 2)), np.array([1, 5, 3]), 0.1, (*QUARTIC, None)
    )
    for row, steps in enumerate((1, 5, 3)):
        alone = advance([[1.0, 1.0]], [[1.0, 1.0]], steps, 0.1, QUARTIC)
        np.testing.assert_array_equal(alone.position[0], together.position[row])
        np.testing.assert_array_equal(alone.momentum[0], together.momentum[row])


def test_the_mean_of_the_exponential_of_energy_errors_is_one() -> None:
    """In equilibrium, 4,000 chains: within 4 standard errors (a false alarm in 16,000)."""
    kernel = HMC(quartic, quartic_gradient, step_size=0.4, steps=8)
    weights = np.exp(-run(kernel, [0.5, 0.5], n=1, chains=4000, burn_in=60, seed=2).info["energy_error"][:, 0])
    assert abs(weights.mean() - 1) < 4 * weights.std() / 4000**0.5 < 0.05


def microcanonical_end(x: Any, angles: Any, steps: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where trajectories of two dimensions end, in positions and angles, and their work."""
    kernel = Microcanonical(quartic, quartic_gradient, steps=steps, covariance=ROOT @ ROOT.T)
    state = gradient_state(quartic, quartic_gradient, x)
    u = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    end, u, work = kernel.trajectory(state, u, np.full(len(x), 0.15))
    return end.position, np.arctan2(u[:, 1], u[:, 0]), work


def test_microcanonical_trajectories_are_reversible() -> None:
    x, angle = np.array([[0.7, -0.4]]), np.array([0.3])
    position, turned, work = microcanonical_end(x, angle, 60)
    back, again, undone = microcanonical_end(position, turned + np.pi, 60)
    np.testing.assert_allclose(back, x, atol=1e-12)
    np.testing.assert_allclose(np.cos(again - np.pi - angle), 1, atol=1e-12)
    np.testing.assert_allclose(undone, -work, atol=1e-12)


def test_microcanonical_work_is_that_of_density_and_volume() -> None:
    """Minus the logarithms of the densities' ratio and of the Jacobian's determinant, that by central differences."""
    start, step = np.array([0.7, -0.4, 0.3]), 1e-5
    rows = start + step * np.concatenate([np.eye(3), -np.eye(3), np.zeros((1, 3))])
    position, angles, work = microcanonical_end(rows[:, :2], rows[:, 2], 12)
    ends = np.column_stack([position, angles])
    volume = np.linalg.det((ends[:3] - ends[3:6]) / (2 * step))
    ratio = quartic(position[6:]) - quartic(start[None, :2])
    assert abs(np.log(volume)) > 0.05
    assert work[6] == pytest.approx(-ratio[0] - np.log(volume), abs=1e-7)


def test_microcanonical_trajectories_that_leave_the_numbers_are_rejected() -> None:
    """On the half line x > 0 with a gradient that is no number outside: draws stay exact, to 1 in 10,000."""

    def half(x: Any) -> Any:
        return np.where(x[:, 0] > 0, -x[:, 0] - 0.5 * x[:, 1] ** 2, -np.inf)

    def slopes(x: Any) -> Any:
        return np.where(x[:, :1] > 0, np.stack([-np.ones(len(x)), -x[:, 1]], axis=1), np.nan)

    rng = np.random.default_rng(4)
    kernel = Microcanonical(half, slopes, step_size=0.8, steps=5, decades=1.0)
    state = kernel.init(np.stack([rng.exponential(size=10_000), rng.normal(size=10_000)], axis=1))
    for _ in range(6):
        state, info = kernel.step(state, rng.uniform(size=(10_000, kernel.dims(2))))
    assert np.isinf(info.energy_error).any()
    assert state.position[:, 0].min() > 0
    assert stats.kstest(state.position[:, 0], "expon").pvalue > 1e-4
    assert stats.kstest(state.position[:, 1], "norm").pvalue > 1e-4


RHO = 0.99
INVERSE = np.linalg.inv([[1, RHO], [RHO, 1]])
NARROW = (lambda x: -0.5 * ((x @ INVERSE) * x).sum(axis=1), lambda x: -x @ INVERSE)


def check_moments(chains: Any) -> None:
    draws = chains.kept_draws()
    assert (np.abs(draws.mean(axis=(0, 1))) < 4 * chains.diagnostics().mcse_mean).all()
    np.testing.assert_allclose(draws.reshape(-1, 2).var(axis=0), 1, rtol=0.05)
    assert np.corrcoef(draws.reshape(-1, 2).T)[0, 1] == pytest.approx(RHO, abs=0.003)


def test_hmc_on_a_narrow_normal() -> None:
    """Means within 4 MCSE; draws for each gradient at least twice those of the best of four random walks."""
    start = np.random.default_rng(1).normal(size=(40, 1)) * np.ones(2)
    chains = run(HMC(*NARROW, step_size=0.1, steps=24), start, n=1000, seed=4)
    check_moments(chains)
    assert chains.acceptance.mean() == pytest.approx(0.947, abs=0.01)
    worth = chains.diagnostics().ess_bulk.min() / chains.info["gradients"].sum()
    assert worth == pytest.approx(0.0216, rel=0.15)
    walks = [run(RandomWalk(NARROW[0], scale=scale), start, n=2000, seed=4) for scale in (0.1, 0.2, 0.5, 1.0)]
    best = max(walk.diagnostics().ess_bulk.min() / 80_000 for walk in walks)
    assert worth > 2 * best


def test_nuts_on_a_narrow_normal() -> None:
    check_moments(NUTS(*NARROW).run([[1.0, 0.9], [-1.0, -1.1]], n=1200, chains=3, warm_up=250, seed=2))
