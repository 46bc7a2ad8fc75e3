"""Particle filters against exact answers: resampling, sorts, Kalman, likelihoods, filtering means, bits, refusals."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import special, stats

import evenlight.smc
from conftest import ROOT
from evenlight import smc
from evenlight.points import SEQUENCES, Halton, Independent, LatinHypercube, Lattice, Sobol


def simulate(model: smc.StateSpaceModel, steps: int, seed: int) -> tuple[Any, Any]:
    """States and observations of a linear Gaussian or a stochastic volatility model."""
    generator = np.random.default_rng(seed)
    states = [model.init(generator.random((1, model.init_uniforms)))]
    for t in range(1, steps):
        states.append(model.move(t, states[-1], generator.random((1, model.move_uniforms))))
    hidden = np.concatenate(states)
    if isinstance(model, smc.LinearGaussian):
        noise = np.linalg.cholesky(model.observation_noise) @ generator.normal(size=(model.outputs, steps))
        return hidden, hidden @ model.observation.T + noise.T
    return hidden, np.exp(hidden[:, 0] / 2) * generator.normal(size=steps)


def walk(d: int, spread: float = 1.0) -> smc.LinearGaussian:
    """Guarniero's model of the benchmark: coordinates that pull each other."""
    places = np.arange(d)
    transition = 0.4 ** (1 + np.abs(places[:, None] - places))
    return smc.LinearGaussian(transition, np.eye(d), np.eye(d), spread**2 * np.eye(d))


@pytest.mark.parametrize("name", smc.RESAMPLING)
def test_every_resampling_draws_each_particle_as_often_as_its_weight_says(name: str) -> None:
    """Chi-square of mean counts over 2,000 draws; a false alarm once in 10⁵ runs of each scheme."""
    generator = np.random.default_rng(1)
    weights = np.array([0.0, 0.3, 0.05, 0.15, 0.0, 0.45, 0.05, 0.0])
    counts = []
    for u in generator.random((2000, 11)):
        drawn = smc.resample(name, weights, u)
        assert len(drawn) == 11
        assert (np.diff(drawn) >= 0).all()
        counts.append(np.bincount(drawn, minlength=8))
    deviations = (np.mean(counts, axis=0) - 11 * weights)[weights > 0]
    assert not np.sum(counts, axis=0)[weights == 0].any()
    covariance = np.cov(np.array(counts)[:, weights > 0].T) / 2000
    statistic = deviations @ np.linalg.pinv(covariance, rcond=1e-9, hermitian=True) @ deviations
    assert stats.chi2.sf(statistic, np.linalg.matrix_rank(covariance, 1e-9)) > 1e-5


@pytest.mark.parametrize("name", smc.RESAMPLING)
def test_resampling_of_equal_weights_and_of_a_single_one(name: str) -> None:
    u = np.random.default_rng(2).random(1000)
    if name != "multinomial":
        assert (smc.resample(name, np.full(1000, 1e-3), u) == np.arange(1000)).all()
    assert (smc.resample(name, np.eye(1000)[-1], u) == 999).all()
    assert (smc.resample(name, np.eye(1000)[0], np.full(1000, np.nextafter(1.0, 0.0))) == 0).all()


def test_stratified_resampling_is_inversion() -> None:
    generator = np.random.default_rng(3)
    weights = generator.random(257) ** 8
    u = generator.random(64)
    sums = np.cumsum(weights) / weights.sum()
    expected = np.searchsorted(sums, (np.arange(64) + u) / 64, side="right")
    assert (smc.resample("stratified", weights, u) == expected).all()
    shifted = np.searchsorted(sums, (np.arange(64) + u[0]) / 64, side="right")
    assert (smc.resample("systematic", weights, u) == shifted).all()


@pytest.mark.parametrize("name", smc.SORTS)
@pytest.mark.parametrize("d", [1, 2, 3])
def test_every_sort_is_a_permutation_that_brings_neighbors_together(name: str, d: int) -> None:
    states = np.random.default_rng(4).normal(size=(4096, d))
    order = smc.SORTS[name].order(states)
    assert (np.sort(order) == np.arange(4096)).all()
    if d == 1:
        assert (np.diff(states[order, 0]) >= 0).all()
    elif name != "coordinate":
        mean = np.linalg.norm(np.diff(states[order], axis=0), axis=1).mean()
        assert mean < np.linalg.norm(np.diff(states, axis=0), axis=1).mean() / 4


def test_equal_and_negative_numbers_are_sorted_and_keep_their_places() -> None:
    x = np.array([[0.0], [-1.0], [np.inf], [0.0], [-np.inf], [-1e-300], [2.0], [-1.0]])
    assert smc.SORTS["coordinate"].order(x).tolist() == [4, 1, 7, 5, 0, 3, 6, 2]


@pytest.mark.parametrize(
    ("folder", "registry"),
    [
        ("models", smc.MODELS),
        ("resampling", smc.RESAMPLING),
        ("sorts", smc.SORTS),
        ("chains", smc.CHAINS),
    ],
)
def test_no_file_of_a_family_is_forgotten(folder: str, registry: dict[str, Any]) -> None:
    shared = {"__init__", "inverse_cdf", "sort", "chain"}
    files = {path.stem for path in (ROOT / "python/evenlight/smc" / folder).glob("*.py")} - shared
    assert files == set(registry)
    assert Path(evenlight.smc.__file__).parent.name == "smc"


def test_kalman_is_the_joint_normal_density() -> None:
    """All at once: five observations of a model of two dimensions are one normal vector."""
    model = smc.LinearGaussian(
        [[0.8, 0.3], [-0.1, 0.5]],
        [[1.0, 0.2], [0.2, 0.5]],
        [[1.0, -0.5]],
        0.3,
        mean=[1.0, -1.0],
        covariance=0.7 * np.eye(2),
    )
    y = np.array([0.3, 1.2, -0.5, 0.1, 2.0])
    powers = [np.linalg.matrix_power(model.transition, k) for k in range(5)]
    means = np.array([power @ model.mean for power in powers])
    covariances = [model.covariance]
    for _ in range(4):
        covariances.append(model.transition @ covariances[-1] @ model.transition.T + model.noise)
    blocks = [
        [covariances[s] @ powers[t - s].T if t >= s else (covariances[t] @ powers[s - t].T).T for t in range(5)]
        for s in range(5)
    ]
    joint = np.block(blocks)
    seen = np.kron(np.eye(5), model.observation)
    spread = seen @ joint @ seen.T + 0.3 * np.eye(5)
    result = smc.kalman(model, y)
    expected = stats.multivariate_normal(seen @ means.ravel(), spread).logpdf(y)
    assert math.isclose(result.log_likelihood, expected, rel_tol=1e-12)
    gain = joint @ seen.T @ np.linalg.inv(spread)
    smooth = means.ravel() + gain @ (y - seen @ means.ravel())
    assert np.allclose(result.smoothing_means.ravel(), smooth, atol=1e-12)
    posterior = joint - gain @ seen @ joint
    assert np.allclose(result.smoothing_covariances[2], posterior[4:6, 4:6], atol=1e-12)
    assert np.allclose(result.filtering_means[-1], smooth[-2:], atol=1e-12)


@pytest.mark.parametrize("points", [None, Sobol, Halton, Lattice(1), Independent])
@pytest.mark.parametrize("d", [1, 2])
def test_the_likelihood_is_unbiased_and_the_means_are_right(points: Any, d: int) -> None:
    """The mean of 60 likelihoods over the truth is 1; z below 4.5 (heavy right tails: once in some thousand runs)."""
    model = walk(d)
    _, y = simulate(model, 12, seed=5)
    exact = smc.kalman(model, y)
    evidence = smc.filter(model, y, particles=256, points=points, replicates=60, seed=7)
    ratios = np.exp(evidence.diagnostics["replicates"] - exact.log_likelihood)
    assert abs(ratios.mean() - 1) < 4.5 * stats.sem(ratios)
    assert math.isclose(evidence.value, exact.log_likelihood + math.log(ratios.mean()), abs_tol=1e-12)
    deviations = evidence.diagnostics["filtering_means"] - exact.filtering_means
    z = deviations / np.hypot(
        evidence.diagnostics["filtering_standard_errors"], 2e-3
    )  # 2e-3: their bias of order 1 / n
    assert np.abs(z).max() < 5
    assert evidence.diagnostics["effective_sizes"].shape == (12,)


@pytest.mark.parametrize("resampling", smc.RESAMPLING)
@pytest.mark.parametrize("threshold", [0.0, 0.5, 1.0])
def test_every_resampling_and_threshold_is_unbiased(resampling: str, threshold: float) -> None:
    """As above: z below 4.5."""
    model = walk(1, 0.7)
    _, y = simulate(model, 6, seed=6)
    truth = smc.kalman(model, y).log_likelihood
    evidence = smc.filter(model, y, particles=200, resampling=resampling, threshold=threshold, replicates=80, seed=3)
    ratios = np.exp(evidence.diagnostics["replicates"] - truth)
    assert abs(ratios.mean() - 1) < 4.5 * stats.sem(ratios)


@pytest.mark.parametrize("points", [None, Sobol])
def test_a_guided_filter_is_unbiased_and_better(points: Any) -> None:
    model = walk(2, 0.3)
    _, y = simulate(model, 20, seed=8)
    truth = smc.kalman(model, y).log_likelihood
    settings: dict[str, Any] = {"particles": 256, "points": points, "replicates": 40, "seed": 2}
    guided = smc.filter(model, y, proposal=smc.OptimalProposal(model), **settings)
    ratios = np.exp(guided.diagnostics["replicates"] - truth)
    assert abs(ratios.mean() - 1) < 4.5 * stats.sem(ratios)
    errors = [
        np.mean((run.diagnostics["replicates"] - truth) ** 2) for run in (guided, smc.filter(model, y, **settings))
    ]
    assert errors[0] < errors[1] / 10  # measured: 1/200 and less; an F(40, 40) variable exceeds 4 once in 10⁴


def test_sequential_quasi_monte_carlo_at_512_particles() -> None:
    """27 to 100 times less than systematic resampling is published experience; F(60, 60) > 2.5 once in 5,000."""
    model = smc.LinearGaussian(0.9, 1.0, 1.0, 1.0)
    _, y = simulate(model, 50, seed=9)
    truth = smc.kalman(model, y).log_likelihood
    random, even = (
        smc.filter(model, y, particles=512, points=points, replicates=60, seed=4) for points in (None, Sobol)
    )
    errors = [np.mean((run.diagnostics["replicates"] - truth) ** 2) for run in (random, even)]
    print("ratio of mean squared errors:", errors[0] / errors[1])
    assert errors[0] / errors[1] >= 20
    ratios = np.exp(even.diagnostics["replicates"] - truth)
    assert abs(ratios.mean() - 1) < 4 * stats.sem(ratios)  # 6 in 10⁵
    assert even.standard_error < random.standard_error / 3


def test_stochastic_volatility_agrees_with_quadrature() -> None:
    """Two observations: a double integral."""
    model, y = smc.StochasticVolatility(-0.5, 0.9, 0.4), [0.7, -1.6]
    spread = 0.4 / math.sqrt(1 - 0.81)

    x, width = np.linspace(-9.0, 8.0, 1201, retstep=True)  # the trapezoidal rule is exact to rounding here
    moves = stats.norm.pdf(x, -0.5, spread)[:, None] * stats.norm.pdf(x, -0.5 + 0.9 * (x[:, None] + 0.5), 0.4)
    seen = [stats.norm.pdf(value, 0, np.exp(x / 2)) for value in y]
    exact = math.log(seen[0] @ moves @ seen[1] * width**2)
    evidence = smc.filter(model, y, particles=4096, points=Sobol, replicates=16, seed=1)
    assert abs(evidence.value - exact) < 5 * evidence.standard_error < 5e-4  # Student's t of 15: 1.6e-4


@pytest.mark.parametrize("name", smc.MODELS)
def test_densities_of_models_are_those_of_their_moves(name: str) -> None:
    """The mean of p / q is 1 where q is a wider normal density; z below 4 (6 in 10⁵)."""
    model: Any = {"linear_gaussian": walk(2), "stochastic_volatility": smc.StochasticVolatility()}[name]
    d = model.dims
    u = np.random.default_rng(1).random((20_000, d))
    previous = model.init(u)
    assert (model.init(u) == previous).all()
    for draws, logpdf in (
        (model.init(u), model.log_init),
        (
            model.move(1, np.tile(previous[:1], (len(u), 1)), u),
            lambda x: model.log_move(1, np.tile(previous[:1], (len(x), 1)), x),
        ),
    ):
        wide = stats.multivariate_normal(draws.mean(axis=0), 2 * np.cov(draws.T))
        x = wide.rvs(20_000, random_state=2).reshape(-1, d)
        ratios = np.exp(logpdf(x) - np.atleast_1d(wide.logpdf(x)))
        assert abs(ratios.mean() - 1) < 4 * stats.sem(ratios)
        grid = np.array([-0.5, 0.0, 0.5]) * draws.std(axis=0)[0] + draws.mean(axis=0)[0]
        for edge in grid:  # the same law: how much is below an edge
            weight = ratios * (x[:, 0] < edge)
            assert abs(weight.mean() - (draws[:, 0] < edge).mean()) < 4 * math.hypot(
                stats.sem(weight), 0.5 / math.sqrt(20_000)
            )


@pytest.mark.parametrize("points", [None, Sobol])
def test_the_same_seed_gives_the_same_bits(points: Any) -> None:
    model = walk(2)
    _, y = simulate(model, 40, seed=1)
    runs = [
        smc.filter(model, y, particles=512, points=points, replicates=r, seed=s) for r, s in ((3, 1), (5, 1), (3, 2))
    ]
    logs = [run.diagnostics["replicates"] for run in runs]
    assert (logs[0] == logs[1][:3]).all()
    assert not (logs[0] == logs[2]).any()
    assert len(set(logs[1].tolist())) == 5


def test_estimates_merge_as_likelihoods_not_as_logarithms() -> None:
    model = walk(1)
    _, y = simulate(model, 10, seed=2)
    runs = [smc.filter(model, y, particles=128, replicates=6, seed=seed) for seed in range(3)]
    merged = runs[0].merge(runs[1]).merge(runs[2])
    again = runs[0].merge(runs[2].merge(runs[1]))
    logs = np.concatenate([run.diagnostics["replicates"] for run in runs])
    assert math.isclose(merged.value, special.logsumexp(logs) - math.log(18), rel_tol=1e-14)
    assert math.isclose(merged.value, again.value, rel_tol=1e-14)
    assert (merged.replicates, merged.n, merged.degrees_of_freedom) == (18, 3 * runs[0].n, 17)
    relative = np.exp(logs - merged.value)
    assert math.isclose(merged.standard_error, stats.sem(relative), rel_tol=0.1)
    with pytest.raises(ValueError, match="same numbers"):
        runs[0].merge(runs[0])
    with pytest.raises(ValueError, match="number of particles"):
        runs[0].merge(smc.filter(model, y, particles=64, replicates=2, seed=9))


def test_any_function_of_the_states_is_filtered() -> None:
    model = walk(2)
    _, y = simulate(model, 5, seed=3)
    exact = smc.kalman(model, y)
    evidence = smc.filter(model, y, particles=1024, points=Sobol, function=lambda x: x[:, 0] ** 2, seed=1)
    squares = exact.filtering_means[:, 0] ** 2 + exact.filtering_covariances[:, 0, 0]
    assert np.allclose(evidence.diagnostics["filtering_means"], squares, atol=0.02)


class Impossible(smc.StochasticVolatility):
    """No state explains the third observation."""

    def log_observation(self, t: int, previous: Any, states: Any, y: Any) -> Any:
        """Nothing at time 2."""
        return np.full(len(states), -np.inf if t == 2 else 0.0)


class Misshapen(smc.StochasticVolatility):
    """States of the wrong shape."""

    def move(self, t: int, states: Any, u: Any) -> Any:
        """One axis too few."""
        return states[:, 0]


def test_refusals_name_the_culprit() -> None:
    model, y = smc.StochasticVolatility(), [0.1, 0.2, 0.3]
    with pytest.raises(TypeError, match="model must be a StateSpaceModel, not str"):
        smc.filter("model", y)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="observations"):
        smc.filter(model, [])
    with pytest.raises(ValueError, match="particles must be at least 2"):
        smc.filter(model, y, particles=1)
    with pytest.raises(ValueError, match="replicates"):
        smc.filter(model, y, replicates=0)
    with pytest.raises(ValueError, match="unknown resampling 'best'; known: systematic"):
        smc.filter(model, y, resampling="best")
    with pytest.raises(ValueError, match="threshold"):
        smc.filter(model, y, threshold=1.5)
    with pytest.raises(ValueError, match="no randomness"):
        smc.filter(model, y, points=Sobol(1, scramble="none"))
    with pytest.raises(ValueError, match="an end"):
        smc.filter(model, y, points=LatinHypercube)
    with pytest.raises(TypeError, match="points must be one of"):
        smc.filter(model, y, points=np.random.default_rng(1))
    with pytest.raises(ValueError, match="weights of all particles are zero at time 2"):
        smc.filter(Impossible(), y)
    with pytest.raises(ValueError, match="states must have shape"):
        smc.filter(Misshapen(), y)
    with pytest.raises(NotImplementedError, match="Counts has no log_init"):
        type("Counts", (smc.StateSpaceModel,), {})().log_init(np.zeros((1, 1)))
    with pytest.raises(ValueError, match="positive definite"):
        smc.LinearGaussian(0.5, -1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="no stationary"):
        smc.LinearGaussian(1.0, 1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="observation must be finite numbers of shape"):
        smc.LinearGaussian(0.5, 1.0, [[1.0, 2.0]], 1.0)
    assert set(SEQUENCES) >= {"sobol", "halton"}
