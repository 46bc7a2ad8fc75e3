"""Importance sampling: densities against SciPy, bounds on exact sums, estimates against exact answers."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

from conftest import ROOT
from evenlight import importance
from evenlight.importance import HEURISTICS, Callables, Normal, StudentT, as_density, mixture_estimate
from evenlight.importance.mixture import Mixture, counts
from evenlight.importance.regression import fit
from evenlight.integrands.singular_point import mean_of_power
from evenlight.lab import rare_event, singularity, variance_constants
from evenlight.points import Independent, Sobol

COVARIANCE = np.array([[2.0, 0.5], [0.5, 1.0]])
UNIFORM = np.full(11, 1 / 11)
TAIL = stats.norm.sf(3)


def beyond_three(x: np.ndarray) -> np.ndarray:
    return np.asarray((x[:, 0] > 3).astype(float))


TOY = (Normal([0.0]), [Normal([0.0]), Normal([3.0]), Normal([-3.0])])


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        (Normal([1, 2], COVARIANCE), stats.multivariate_normal([1, 2], COVARIANCE)),
        (StudentT([1, 2], COVARIANCE, df=3), stats.multivariate_t([1, 2], COVARIANCE, df=3)),
    ],
)
def test_densities_are_those_of_scipy(ours: Any, theirs: Any) -> None:
    x = np.random.default_rng(2).normal(size=(100, 2)) * 4
    np.testing.assert_allclose(ours.logpdf(x), theirs.logpdf(x), rtol=1e-12)
    np.testing.assert_allclose(as_density(theirs).logpdf(x), theirs.logpdf(x), rtol=1e-12)


@pytest.mark.parametrize(
    ("density", "marginal"),
    [
        (Normal([1, 2], COVARIANCE), stats.norm(2, 1)),
        (StudentT([1, 2], COVARIANCE, df=3), stats.t(3, 2, 1)),
        (stats.expon(scale=3), stats.expon(scale=3)),
        (Callables(1, np.sqrt, lambda x: np.log(2 * x[:, 0])), stats.beta(2, 1)),
    ],
)
def test_points_follow_their_density(density: Any, marginal: Any) -> None:
    """Kolmogorov and Smirnov, 20,000 points: a false alarm in 1,000."""
    drawn = as_density(density)
    x = drawn.sample(Independent(drawn.uniforms, seed=4).points(0, 20_000))
    assert x.shape == (20_000, drawn.d)
    assert stats.kstest(x[:, -1], marginal.cdf).pvalue > 1e-3


def test_new_style_distributions_are_densities() -> None:
    distribution = stats.Normal(mu=1.0, sigma=2.0)
    np.testing.assert_allclose(as_density(distribution).logpdf(np.array([[0.3]])), distribution.logpdf(0.3))


def test_what_is_no_density_is_refused() -> None:
    with pytest.raises(TypeError, match="no density"):
        as_density("normal")
    with pytest.raises(ValueError, match="not positive definite"):
        Normal([0, 0], [[1, 2], [2, 1]])
    with pytest.raises(TypeError, match="a list of densities, not Normal"):
        Mixture(Normal([0]), Normal([0]))  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="proposal 1 has 2 dimensions, the target 1"):
        Mixture(Normal([0]), [Normal([0]), Normal([0, 0])])


def test_counts_add_up_and_are_near() -> None:
    generator = np.random.default_rng(1)
    for _ in range(200):
        alpha = generator.dirichlet(np.full(7, 0.3))
        numbers = counts(alpha, 1000)
        assert numbers.sum() == 1000
        assert np.abs(numbers - 1000 * alpha).max() <= 1


@pytest.mark.parametrize("name", HEURISTICS)
def test_weights_add_up_to_one_where_there_is_density(name: str) -> None:
    expected = np.random.default_rng(1).exponential(size=(1000, 4)) ** 8
    expected[:50, 0] = 0
    weights = importance.weights(name, expected)
    np.testing.assert_allclose(weights.sum(axis=1), 1, rtol=1e-12)
    assert (weights >= 0).all()
    assert (weights[:50, 0] == 0).all()


@pytest.mark.parametrize("name", HEURISTICS)
def test_every_heuristic_is_unbiased(name: str) -> None:
    target, proposals = TOY
    runs = [
        importance.multiple_importance(
            beyond_three, target, proposals, counts=[500, 2000, 500], heuristic=name, seed=seed
        )
        for seed in range(30)
    ]
    values = np.array([run.value for run in runs])
    assert abs(values.mean() - TAIL) < 4 * stats.sem(values)
    stated = np.mean([run.standard_error**2 for run in runs])
    assert 0.5 < values.var(ddof=1) / stated < 1.8  # chi-square with 29 degrees of freedom, 1e-3 on either side


def discrete_problem(seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """f, p, q, alpha on 60 atoms, where all integrals are sums."""
    generator = np.random.default_rng(seed)
    atoms, components = 60, 4
    p = generator.dirichlet(np.full(atoms, 0.5))
    q = generator.dirichlet(np.full(atoms, 0.3), size=components).T + 1e-12
    q[:, 0] = p
    f = generator.exponential(size=atoms) ** 3 * np.sign(generator.normal(size=atoms))
    return f, p, q / q.sum(axis=0), generator.dirichlet(np.full(components, 1.0)) * 0.8 + 0.05


@pytest.mark.parametrize("seed", range(40))
def test_the_bounds_of_theory_hold(seed: int) -> None:
    f, p, q, alpha = discrete_problem(seed)
    y, t = f * p, q @ alpha
    mean = float(y.sum())
    plain = float((f**2 * p).sum()) - mean**2
    balance = float((y**2 / t).sum()) - mean**2
    # Hesterberg: a defensive mixture with the share alpha_0 of the target
    assert balance <= plain / alpha[0] + (1 - alpha[0]) / alpha[0] * mean**2 + 1e-9
    assert (p / t).max() <= 1 / alpha[0] + 1e-9
    # Owen and Zhou: with control variates, no worse than any component alone over its share
    residuals = fit(y, q, 1 / t).residuals
    controlled = float((residuals**2 / t).sum())
    for j in range(4):
        alone = float((y**2 / q[:, j]).sum()) - mean**2
        assert controlled <= alone / alpha[j] * (1 + 1e-9)
    # Veach and Guibas: fixed counts n_j = n alpha_j, against the other heuristics, n times the variance
    expected = q * alpha
    variances = {}
    for name in HEURISTICS:
        shares = importance.weights(name, expected)
        each = [(shares[:, j] * y / q[:, j]) for j in range(4)]
        second = [float((each[j] ** 2 * q[:, j]).sum() - (each[j] * q[:, j]).sum() ** 2) for j in range(4)]
        variances[name] = sum(second[j] / alpha[j] for j in range(4))
    for name in ("power", "cutoff", "maximum"):
        assert variances["balance"] <= variances[name] + (1 / alpha.min() - 1) * mean**2 + 1e-9


def test_dependent_control_variates_are_harmless() -> None:
    """F p in the span of densities that depend on each other: the variance is 0 but for rounding."""
    target = Normal([0.0])
    proposals = [Normal([0.0]), Normal([0.0]), Normal([1.0]), Normal([1.0], 1.0 + 1e-14)]
    f = lambda x: 2 + 3 * np.exp(x[:, 0] - 0.5)  # noqa: E731  # N(1, 1) / N(0, 1) = exp(x - 1/2)
    estimate = mixture_estimate(f, target, proposals, alpha="uniform", n=4000)
    assert estimate.value == pytest.approx(5.0, rel=1e-10)
    assert estimate.diagnostics["variance"] < 1e-20 * 25


def test_the_toy_has_the_variances_of_quadrature() -> None:
    """Uniform mixture: 2.198e-5 with random components, less with fixed counts, 1.774e-5 with control variates."""
    target, proposals = TOY
    controlled = mixture_estimate(beyond_three, target, proposals, alpha="uniform", n=2**17, seed=1)
    assert controlled.diagnostics["variance"] == pytest.approx(1.773692e-5, rel=0.05)
    assert abs(controlled.value - TAIL) < 4 * controlled.standard_error
    points = Independent(2, seed=5)  # random components
    plain = mixture_estimate(
        beyond_three, target, proposals, alpha="uniform", beta=None, n=2**18, points=points, replicates=2**9
    )
    assert plain.diagnostics["variance"] == pytest.approx(2.198234e-5, rel=0.3)  # 511 degrees of freedom: 5 sigma


def test_points_work_inside_a_mixture() -> None:
    problem = singularity()
    errors = {}
    for name, points in (("sobol", Sobol(6, seed=2)), ("independent", Independent(6, seed=2))):
        estimate = mixture_estimate(problem.f, problem.target, problem.proposals, n=2**15, pilot=4000, points=points)
        assert abs(estimate.value - problem.exact) < 5 * estimate.standard_error
        errors[name] = estimate.standard_error
    assert errors["sobol"] < errors["independent"] / 1.5


def test_variance_constants_of_the_singularity() -> None:
    """The sheet's figures, which have a standard error of 0.3 %: ours agree within 2 %."""
    problem = singularity()
    assert variance_constants(problem, np.eye(11)[10], n=2**14).independent == pytest.approx(0.7109642, rel=0.005)
    uniform = variance_constants(problem, UNIFORM)
    np.testing.assert_allclose(uniform, [0.0997, 0.0538, 0.03112], rtol=0.02)
    learned = np.full(11, 0.1 / 11)
    learned[[0, 1, 4]] = 0.1, 0.29, 0.045
    learned[10] = 1 - learned[:10].sum()
    np.testing.assert_allclose(variance_constants(problem, learned), [0.01402, 0.01288, 0.01137], rtol=0.02)
    assert 0.7109642 / uniform.independent > 7
    assert 0.7109642 / variance_constants(problem, learned).control_variates > 60


def test_variance_constants_of_the_rare_event() -> None:
    problem = rare_event()
    uniform = variance_constants(problem, UNIFORM, n=2**14)
    np.testing.assert_allclose(uniform, [4.272e-14, 3.899e-14, 3.89e-14], rtol=0.005)
    optimal = np.full(11, 0.1 / 11)
    optimal[:2] = 0.7067, 1 - 0.7067 - 0.9 / 11
    best = variance_constants(problem, optimal, n=2**14)
    np.testing.assert_allclose(best, [6.021e-15, 5.965e-15, 5.96e-15], rtol=0.005)
    assert problem.exact / uniform.independent > 5e5
    assert 5 < uniform.independent / best.independent < 9


def test_weights_of_the_rare_event_are_learned() -> None:
    problem = rare_event()
    estimate = mixture_estimate(problem.f, problem.target, problem.proposals, n=100_000, pilot=11_000, seed=3)
    assert estimate.value == pytest.approx(problem.exact, rel=0.04)
    assert estimate.standard_error < 0.0125 * problem.exact
    assert estimate.diagnostics["alpha"][0] == pytest.approx(0.706, abs=0.08)
    assert estimate.diagnostics["alpha"][1] == pytest.approx(0.211, abs=0.08)
    assert estimate.cost == 111_000
    assert estimate.n == 100_000


def test_tail_index_is_that_of_pareto_weights() -> None:
    u = Independent(1, seed=9).points(0, 200_000)[:, 0]
    for k in (0.2, 0.7, 1.2):
        assert importance.tail_index((1 - u) ** -k) == pytest.approx(k, abs=0.12)
    assert importance.tail_index(np.ones(1000)) == -np.inf


def test_self_normalization_needs_no_constant() -> None:
    """Of a target known up to a factor, the second moment; the plain estimate would be 7 times as large."""
    unnormalized = Callables(1, lambda u: u, lambda x: np.log(7.0) + stats.norm.logpdf(x[:, 0]))
    f = lambda x: x[:, 0] ** 2  # noqa: E731
    estimate = importance.importance_sampling(f, unnormalized, StudentT([0.0]), n=50_000, self_normalized=True)
    assert abs(estimate.value - 1) < 4 * estimate.standard_error
    assert 0.3 < estimate.diagnostics["ess"] / 50_000 <= 1


def test_estimates_of_mixtures_merge() -> None:
    target, proposals = TOY
    runs = [mixture_estimate(beyond_three, target, proposals, n=3000, seed=seed) for seed in range(3)]
    merged = runs[0].merge(runs[1]).merge(runs[2])
    assert merged.value == pytest.approx(np.mean([run.value for run in runs]), rel=1e-3)
    assert merged.standard_error < 0.7 * runs[0].standard_error
    assert merged.n == 9000


@pytest.mark.parametrize("aim", ["entropy", "variance", "weights"])
def test_learned_mixtures_are_at_least_as_good_as_what_they_began_with(aim: Any) -> None:
    problem = singularity()
    estimate = importance.adaptive_estimate(problem.f, problem.target, problem.proposals, n=30_000, aim=aim, seed=5)
    assert abs(estimate.value - problem.exact) < 5 * estimate.standard_error
    most = {"entropy": 0.15, "variance": 0.15, "weights": 1.1}[aim]
    assert estimate.diagnostics["variance"] < most * 0.01137  # the best that weights alone can do
    assert (estimate.n, estimate.cost) == (24_000, 30_000)


def test_learning_does_not_run_away_from_a_rare_event() -> None:
    problem = rare_event()
    estimate = importance.adaptive_estimate(problem.f, problem.target, problem.proposals, n=50_000, seed=1)
    assert abs(estimate.value - problem.exact) < 5 * estimate.standard_error
    assert estimate.standard_error < 0.02 * problem.exact


def test_student_t_components_learn_location_and_shape() -> None:
    """Points of the density itself: the fit is likelihood's, a step of which stays near the truth."""
    truth = StudentT([1, 2], COVARIANCE, df=4)
    x = truth.sample(Independent(3, seed=1).points(0, 100_000))
    fitted: Any = truth.fitted(x, np.ones(len(x)))
    np.testing.assert_allclose(fitted.location, [1, 2], atol=0.03)
    np.testing.assert_allclose(fitted.shape, COVARIANCE, atol=0.06)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"alpha": "best"}, "alpha must be 'optimal'"),
        ({"alpha": [1, 1, 1]}, "alpha must be 3 numbers"),
        ({"beta": "ridge"}, "beta must be 'lstsq'"),
        ({"floor": 0.5}, "floors"),
        ({"points": Sobol(3)}, "takes points of 2 dimensions"),
    ],
)
def test_arguments_without_meaning_are_refused(arguments: dict[str, Any], message: str) -> None:
    target, proposals = TOY
    with pytest.raises(ValueError, match=message):
        mixture_estimate(beyond_three, target, proposals, n=1024, **arguments)
    with pytest.raises(TypeError, match=r"a sequence of so many dimensions, Sobol\(d\), not its class"):
        mixture_estimate(beyond_three, target, proposals, n=1024, points=Sobol)


def test_families_have_their_files() -> None:
    folder = ROOT / "python/evenlight/importance"
    assert {path.stem for path in (folder / "heuristics").glob("*.py")} == {*HEURISTICS, "__init__"}
    assert {path.stem for path in (folder / "densities").glob("*.py")} == {*importance.DENSITIES, "__init__", "density"}


def test_what_it_takes_to_gain_a_millionfold() -> None:
    """Factors of 3e6 and then 5: an exponent within 1.3e-7 of where the variance is infinite, and narrower proposals.

    Nearly all of the second moment then lies where no sample will ever be: within exp(-10⁶) of the singularity.
    """
    gamma = 2.5 - 1.27e-7
    problem = singularity(gamma, shrink=4.6)
    covariance = 2.0 ** -np.abs(np.subtract.outer(np.arange(5), np.arange(5)))
    plain = mean_of_power(covariance, np.ones(5), 2 * gamma) - problem.exact**2
    x, weights = problem.locate(Sobol(6, seed=5).points(0, 2**14))
    q = np.stack([np.exp(proposal.logpdf(x)) for proposal in problem.proposals], axis=1)
    fp = problem.f(x) * np.exp(problem.target.logpdf(x))
    best = importance.optimal_mixture(fp, q, 1 / weights, control_variates=False)
    uniform = variance_constants(problem, UNIFORM, n=2**14).independent
    assert plain / uniform == pytest.approx(3e6, rel=0.1)
    assert uniform / variance_constants(problem, best.alpha, n=2**14).independent == pytest.approx(5, rel=0.15)


def entry(f: Any, row: int, column: int) -> Any:
    return lambda x: f(x)[:, row, column]


def test_arrays_of_values_are_estimated_entry_by_entry() -> None:
    """With given weights every entry is what it is alone, up to rounding; learned weights serve all of them."""
    target, proposals = TOY
    both = lambda x: np.stack([beyond_three(x), 5 * (x[:, 0] < -3), x[:, 0] ** 2, x[:, 0]], 1).reshape(-1, 2, 2)  # noqa: E731
    truth = np.array([[TAIL, 5 * TAIL], [1.0, 0.0]])
    methods: dict[str, Any] = {
        "mixture": lambda f: mixture_estimate(f, target, proposals, alpha="uniform", n=3000),
        "points": lambda f: mixture_estimate(f, target, proposals, alpha="uniform", n=2048, points=Sobol(2, seed=1)),
        "plain": lambda f: importance.importance_sampling(f, target, StudentT([0.0]), n=3000),
        "normalized": lambda f: importance.importance_sampling(
            f, target, StudentT([0.0]), n=3000, self_normalized=True
        ),
        "multiple": lambda f: importance.multiple_importance(f, target, proposals, counts=[1000, 1000, 1000]),
    }
    for name, method in methods.items():
        estimate = method(both)
        assert estimate.value.shape == estimate.standard_error.shape == (2, 2), name
        assert (np.abs(estimate.value - truth) <= 5 * estimate.standard_error).all(), name
        for row, column in np.ndindex(2, 2):
            alone = method(entry(both, row, column))
            assert estimate.value[row, column] == pytest.approx(alone.value, rel=1e-9, abs=1e-12), name
            assert estimate.standard_error[row, column] == pytest.approx(alone.standard_error, rel=1e-9), name


def test_weights_for_several_values_serve_all() -> None:
    """Two tails of very different size: weights for one of them alone would starve the other."""
    target, proposals = TOY
    tails = lambda x: np.stack([x[:, 0] > 3, 1e6 * (x[:, 0] < -3)], axis=1)  # noqa: E731
    estimate = mixture_estimate(tails, target, proposals, n=20_000, pilot=5000)
    alpha = estimate.diagnostics["alpha"]
    assert alpha[1] == pytest.approx(alpha[2], abs=0.05)
    assert alpha[1] > 0.4
    assert estimate.diagnostics["beta"].shape == (3, 2)
    relative = estimate.standard_error / estimate.value
    assert relative.max() < 0.02
    assert (np.abs(estimate.value / np.array([TAIL, 1e6 * TAIL]) - 1) < 5 * relative).all()


def test_the_objective_of_several_values_is_the_sum_of_theirs() -> None:
    """Against sums over all atoms: no other weights, of 2,000 at random, are better by more than the gap."""
    generator = np.random.default_rng(5)
    f, p, q, _ = discrete_problem(3)
    fp = np.stack([f * p, generator.exponential(size=60) ** 2 * p], axis=1)
    density = np.full(60, 1 / 60)

    def objective(alpha: np.ndarray) -> float:
        sizes = np.abs(fp).sum(axis=0)
        return float(((fp / sizes) ** 2 / (q @ alpha)[:, np.newaxis]).sum())

    best = importance.optimal_mixture(fp, q, density, floor=0.05, gap=1e-6)
    others = 0.05 + 0.8 * generator.dirichlet(np.ones(4), size=2000)
    assert objective(best.alpha) <= min(objective(alpha) for alpha in others) * (1 + 2e-6)
    assert best.variance.shape == (2,)
    assert best.beta is not None
    for column in range(2):
        alone = fit(fp[:, column], q, 1 / (density * (q @ best.alpha)))
        np.testing.assert_allclose(best.beta[:, column], alone.beta, rtol=1e-9)
    with pytest.raises(ValueError, match="takes one integrand, not 2"):
        importance.optimal_mixture(fp, q, density, control_variates="joint")


def test_components_are_learned_for_several_values() -> None:
    problem = singularity()
    f = lambda x: np.stack([problem.f(x), 1e3 * problem.f(-x)], axis=1)  # noqa: E731  # the target is even
    estimate = importance.adaptive_estimate(f, problem.target, problem.proposals, n=40_000, seed=2)
    assert estimate.value.shape == (2,)
    error = np.abs(estimate.value / [problem.exact, 1e3 * problem.exact] - 1)
    relative = estimate.standard_error / estimate.value
    assert (error < 5 * relative).all()
    assert relative.max() < 2e-3
