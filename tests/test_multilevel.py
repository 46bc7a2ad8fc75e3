"""Multilevel methods against toy hierarchies with known answers: means, promises, costs, checks and refusals."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy import special

from evenlight.estimate import Estimate, NotConvergedWarning
from evenlight.multilevel import (
    CONSTRUCTIONS,
    Coupled,
    FunctionSampler,
    LevelDistribution,
    MultilevelWarning,
    brownian_increments,
    debias,
    level_figure,
    level_table,
    mlmc,
    mlqmc,
    multi_index,
)
from evenlight.multilevel.models import GeometricBrownianMotion
from evenlight.points import Halton, Independent, LatinHypercube, Lattice, Sobol
from toy_levels import BothRefined, ExponentialSeries, NormalLevels, PowerOfUniform, ProductLevels


def errors(run: Callable[[int], Estimate], truth: float, runs: int) -> Any:
    """Errors of runs with seeds from 0 on."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MultilevelWarning)
        return np.array([run(seed).value - truth for seed in range(runs)])


@pytest.mark.parametrize("construction", CONSTRUCTIONS)
@pytest.mark.parametrize("steps", [1, 2, 3, 8, 13])
def test_every_construction_is_a_rotation_of_independent_increments(construction: str, steps: int) -> None:
    rotation = CONSTRUCTIONS[construction](np.eye(steps))
    assert np.allclose(rotation @ rotation.T, np.eye(steps), atol=1e-14)


def test_a_bridge_decides_the_end_first_and_then_the_middle() -> None:
    u = np.random.default_rng(1).random((6, 8))
    u[:, :2] = u[0, :2]
    paths = np.cumsum(brownian_increments(u, horizon=2.0, construction="bridge"), axis=1)
    assert np.allclose(paths[:, -1], math.sqrt(2.0) * special.ndtri(u[0, 0]), atol=1e-14)
    assert np.allclose(np.ptp(paths[:, 3]), 0.0, atol=1e-14)
    assert np.ptp(paths[:, 1]) > 0.1


def test_principal_components_are_those_of_the_covariance() -> None:
    steps = 7
    times = np.arange(1, steps + 1) / steps
    values = np.linalg.eigvalsh(np.minimum.outer(times, times))[::-1]
    paths = np.cumsum(CONSTRUCTIONS["pca"](np.eye(steps)) / math.sqrt(steps), axis=1)
    assert np.allclose((paths**2).sum(axis=1), values, atol=1e-14)


def test_factors_share_columns_in_turn() -> None:
    u = np.random.default_rng(2).random((5, 12))
    for construction in CONSTRUCTIONS:
        together = brownian_increments(u, factors=3, construction=construction)
        for factor in range(3):
            alone = brownian_increments(u[:, factor::3], construction=construction)
            assert np.allclose(together[:, :, factor], alone, atol=1e-14)


# The root mean squared error of 30 runs has a standard error of 13 % of itself. The drivers aim at 0.87 of the
# tolerance at most: 1.15 is 2.5 standard errors above. `statistics/` has more runs.
@pytest.mark.parametrize(("alpha", "beta"), [(1.0, 2.0), (1.0, 1.0), (1.0, 0.5), (2.0, 3.0)])
def test_mlmc_meets_its_tolerance_without_waste(alpha: float, beta: float) -> None:
    toy = NormalLevels(alpha, beta)
    found = errors(lambda seed: mlmc(toy, rmse=0.1, seed=seed), toy.exact_value, 30)
    assert 0.4 < math.sqrt(np.mean(found**2)) / 0.1 < 1.15


def test_mlmc_measures_the_rates_and_reports_them() -> None:
    estimate = mlmc(NormalLevels(1.0, 1.5, 1.25), rmse=0.01, seed=3)
    rates = estimate.diagnostics["rates"]
    assert abs(rates.alpha - 1.0) < 0.3
    assert abs(rates.beta - 1.5) < 0.1
    assert abs(rates.gamma - 1.25) < 1e-9
    rows = estimate.diagnostics["levels"]
    assert estimate.value == pytest.approx(sum(row.mean for row in rows))
    assert estimate.cost == pytest.approx(sum(row.n * row.cost for row in rows))
    assert estimate.standard_error**2 == pytest.approx(sum(row.variance / row.n for row in rows))
    assert estimate.standard_error**2 + estimate.bias**2 <= 1.02 * 0.75 * 0.01**2
    assert all(abs(row.kurtosis - 3.0) < 6 * math.sqrt(24 / row.n) for row in rows)  # of normal numbers, 6 sigma
    assert max(row.consistency for row in rows[1:]) < 1.0
    assert len(level_table(estimate).splitlines()) == len(rows) + 1


def test_numbers_of_samples_follow_the_root_of_variance_over_cost() -> None:
    rows = mlmc(NormalLevels(1.0, 1.0), rmse=0.01, seed=5).diagnostics["levels"][:-2]  # where it decides, few are known
    ratios = [row.n / math.sqrt(row.variance / row.cost) for row in rows]
    assert max(ratios) / min(ratios) < 1.1


@pytest.mark.parametrize("driver", [mlmc, mlqmc])
def test_a_mismatched_coupling_fails_the_consistency_check(driver: Callable[..., Estimate]) -> None:
    with pytest.warns(MultilevelWarning, match="consistency"):
        driver(NormalLevels(1.0, 2.0, mismatch=0.5), rmse=0.01, seed=1)


def test_a_heavy_tail_is_reported() -> None:
    def rare(level: int, u: Any) -> tuple[Any, Any]:
        jump = (u[:, 0] < 2.0**-level * 0.01) * 1.0
        return u[:, 1] + jump, u[:, 1]

    with pytest.warns(MultilevelWarning, match="kurtosis"):
        mlmc(FunctionSampler(rare, dims=2), rmse=0.01, seed=1)


@pytest.mark.parametrize("driver", [mlmc, mlqmc])
def test_the_same_seed_gives_the_same_bits(driver: Callable[..., Estimate]) -> None:
    first, again, other = (driver(PowerOfUniform(), rmse=0.003, seed=seed) for seed in (1, 1, 2))
    assert first.value == again.value
    assert first.value != other.value


def test_a_run_inside_of_a_sampler_does_not_disturb_the_one_outside() -> None:
    class Nested(GeometricBrownianMotion):
        def sample(self, level: int, u: Any) -> Coupled:
            mlmc(GeometricBrownianMotion(), rmse=5.0)
            return super().sample(level, u)

    assert mlmc(Nested(), rmse=1.0, seed=3).value == mlmc(GeometricBrownianMotion(), rmse=1.0, seed=3).value


@pytest.mark.parametrize("driver", [mlmc, mlqmc])
def test_limits_are_reported_as_not_converged(driver: Callable[..., Estimate]) -> None:
    with pytest.warns(NotConvergedWarning, match="max_level = 2"):
        assert not driver(PowerOfUniform(), rmse=1e-3, max_level=2).converged
    with pytest.warns(NotConvergedWarning, match="max_cost"):
        estimate = driver(PowerOfUniform(), rmse=1e-4, max_cost=20_000)
    assert not estimate.converged
    assert estimate.cost <= 20_000


@pytest.mark.parametrize("driver", [mlmc, mlqmc])
def test_several_quantities_share_the_levels(driver: Callable[..., Estimate]) -> None:
    def both(level: int, u: Any) -> tuple[Any, Any]:
        power = np.stack([u[:, 0] ** (1 + 2.0**-level), 2.0 - u[:, 0] ** (1 + 2.0**-level)], axis=1)
        below = np.stack([u[:, 0] ** (1 + 2.0 ** (1 - level)), 2.0 - u[:, 0] ** (1 + 2.0 ** (1 - level))], axis=1)
        return power, below

    estimate = driver(FunctionSampler(both), rmse=0.005, seed=2)
    assert estimate.value.shape == estimate.standard_error.shape == estimate.bias.shape == (2,)
    low, high = estimate.confidence_interval(0.9999)
    assert np.all((low < [0.5, 1.5]) & (high > [0.5, 1.5]))


def test_an_exact_last_level_leaves_no_bias() -> None:
    def halves(level: int, u: Any) -> tuple[Any, Any]:
        return u[:, 0] + 0.5 * (level == 1), u[:, 0] + 0.0

    estimate = mlmc(FunctionSampler(halves, max_level=1, exact=True), rmse=0.01, seed=1)
    assert estimate.bias == 0.0
    assert abs(estimate.value - 1.0) < 0.05


def test_functions_that_draw_their_own_numbers() -> None:
    def drawn(level: int, n: int, generator: np.random.Generator) -> tuple[Any, Any]:
        x = generator.random(n)
        return x ** (1 + 2.0**-level), x ** (1 + 2.0 ** (1 - level))

    sampler = FunctionSampler(drawn, draws=True, name="drawn")
    found = mlmc(sampler, rmse=0.005, seed=4)
    assert abs(found.value - 0.5) < 0.02
    assert found.value == mlmc(sampler, rmse=0.005, seed=4).value
    with pytest.raises(ValueError, match="keys of a generator"):
        mlqmc(sampler, rmse=0.005)


# As for mlmc; whole doublings of the points and whole levels may leave much less error than was allowed.
@pytest.mark.parametrize("points", [Sobol(1), Halton(1), Lattice(1)])
def test_mlqmc_meets_its_tolerance_with_any_randomized_sequence(points: Any) -> None:
    found = errors(lambda seed: mlqmc(PowerOfUniform(), points, rmse=2e-3, seed=seed), 0.5, 10)
    assert 0.2 < math.sqrt(np.mean(found**2)) / 2e-3 < 1.15


def test_evenly_spread_points_need_less_than_independent_ones() -> None:
    costs = [mlqmc(PowerOfUniform(), points, rmse=3e-4, seed=1).cost for points in (Sobol(1), Independent(1))]
    assert costs[0] * 10 < costs[1]


@pytest.mark.parametrize(("alpha", "beta"), [(1.0, 2.0), (2.0, 2.0)])
def test_multi_index_knows_its_bias_and_its_noise(alpha: float, beta: float) -> None:
    toy = ProductLevels(alpha, beta)
    for seed in range(2):
        estimate = multi_index(toy, rmse=0.2, seed=seed)
        rows = {row.level: row for row in estimate.diagnostics["levels"]}
        bias = toy.exact_value - sum(2.0 ** (-alpha * (i + j)) for i, j in rows)
        # a bound: the next means count like those before them, 2^alpha times as large, with the noise of those
        edge = [row for (i, j), row in rows.items() if (i + 1, j) not in rows or (i, j + 1) not in rows]
        noise = sum(math.sqrt(row.variance / row.n) for row in edge)
        assert 0.6 * bias < estimate.bias < 1.5 * 2.0**alpha * bias + 2.0 * noise
        assert abs(estimate.value - (toy.exact_value - bias)) < 4.5 * estimate.standard_error  # false alarm: 4e-5
        assert estimate.standard_error**2 + estimate.bias**2 <= 1.02 * 0.75 * 0.2**2


def test_multi_index_measures_the_rates_of_both_directions() -> None:
    estimate = multi_index(ProductLevels(1.0, 1.5), rmse=0.2, seed=1)
    for rates in estimate.diagnostics["rates"]:
        assert abs(rates.alpha - 1.0) < 0.3
        assert abs(rates.beta - 1.5) < 0.15
        assert rates.gamma == pytest.approx(1.0)
    rows = estimate.diagnostics["levels"]
    pairs = {row.level for row in rows}
    assert all(below in pairs for i, j in pairs for below in ((i - 1, j), (i, j - 1)) if min(below) >= 0)
    assert max(row.consistency for row in rows[1:]) < 1.0


def test_multi_index_needs_less_than_levels_that_refine_both_directions() -> None:
    # mixed differences: ε^-2; both together, β = 2 = γ: ε^-2 log² ε
    costs = [run.cost for run in (multi_index(ProductLevels(1, 2), rmse=0.2), mlmc(BothRefined(1, 2), rmse=0.2))]
    assert costs[0] * 2 < costs[1]


def test_multi_index_stops_at_its_limits() -> None:
    toy = ProductLevels(1.0, 2.0)
    with pytest.warns(NotConvergedWarning, match="max_cost"):
        assert multi_index(toy, rmse=0.001, max_cost=30_000).cost <= 30_000
    toy.max_level = (2, 3)
    with pytest.warns(NotConvergedWarning, match="the bias is beyond the tolerance"):
        assert not multi_index(toy, rmse=0.1, seed=1).converged
    toy.max_level = (1, None)
    with pytest.raises(ValueError, match="too coarse to know the bias"):
        multi_index(toy, rmse=0.02)
    with pytest.raises(TypeError, match="must be a MultiIndexSampler"):
        multi_index(PowerOfUniform(), rmse=0.02)
    for driver in (mlmc, mlqmc):
        with pytest.raises(TypeError, match="use multi_index"):
            driver(toy, rmse=0.02)


def test_points_that_cannot_grow_or_be_repeated_are_refused() -> None:
    for points in (Sobol(1, scramble="none"), LatinHypercube(1)):
        with pytest.raises(ValueError, match="randomized sequence without end"):
            mlqmc(PowerOfUniform(), points, rmse=0.01)
    with pytest.raises(TypeError, match=r"one of evenlight\.points"):
        mlqmc(PowerOfUniform(), "sobol", rmse=0.01)  # type: ignore[arg-type]


@pytest.mark.parametrize("driver", [mlmc, mlqmc])
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"rmse": 0.0}, "rmse must be above 0"),
        ({"rmse": math.nan}, "rmse must be above 0"),
        ({"rmse": 0.1, "max_cost": 0.0}, "max_cost must be above 0"),
        ({"rmse": 0.1, "max_level": 1}, "too coarse to know the bias"),
        ({"rmse": 0.1, "alpha": -1.0}, "alpha must be above 0"),
    ],
)
def test_arguments_that_cannot_work_are_refused(
    driver: Callable[..., Estimate], arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        driver(PowerOfUniform(), **arguments)


def test_what_a_sampler_returns_is_checked() -> None:
    wrong: dict[str, Callable[..., Any]] = {
        "of one shape": lambda level, u: (u[:, 0], u[:3, 0]),
        "nan": lambda level, u: (u[:, 0] * np.nan, u[:, 0]),
    }
    for message, function in wrong.items():
        with pytest.raises(ValueError, match=message):
            mlmc(FunctionSampler(function, name="wrong"), rmse=0.1)
    with pytest.raises(TypeError, match="must be a LevelSampler"):
        mlmc(lambda level, u: u, rmse=0.1)


def test_the_figure_shows_the_table() -> None:
    estimate = mlmc(PowerOfUniform(), rmse=0.01, seed=1)
    rows = estimate.diagnostics["levels"]
    panels = level_figure(estimate).axes
    assert np.array_equal(panels[2].lines[0].get_ydata(), [row.n for row in rows])
    assert np.allclose(2.0 ** panels[0].lines[1].get_ydata(), [row.variance for row in rows[1:]])
    assert np.allclose(panels[4].lines[0].get_ydata(), [row.consistency for row in rows[1:]])
    for show in (level_figure, level_table):
        with pytest.raises(ValueError, match="no levels"):
            show(debias(NormalLevels(1.0, 2.0), n=100))


def test_estimates_of_multilevel_methods_are_plain_data() -> None:
    data = mlmc(PowerOfUniform(), rmse=0.01, seed=1).to_dict()
    assert data["diagnostics"]["levels"][0]["level"] == 0
    assert data["bias"] > 0.0


def test_series_of_e_has_the_known_variances() -> None:
    # E Z² = 2 I_0(2 √2) for p_l = 2^(-l-1); Σ ν_l 2^l for the coupled sum: 11.5869773565
    half = LevelDistribution.geometric(1.0)
    known = {"single": 2.0 * special.i0(2.0 * math.sqrt(2.0)), "coupled": 11.5869773565, "independent": 11.5869773565}
    n = 200_000
    for method, square in known.items():
        estimate = debias(ExponentialSeries(), n=n, method=method, distribution=half, seed=1)
        variance = square - math.e**2
        assert abs(estimate.value - math.e) < 4 * math.sqrt(variance / n), method  # false alarm: 6e-5
        assert estimate.standard_error**2 * n == pytest.approx(variance, rel=0.05), method  # tails of Z: kurtosis < 60


@pytest.mark.parametrize("method", ["single", "independent"])
def test_debiased_estimates_meet_a_tolerance(method: str) -> None:
    toy = NormalLevels(1.0, 2.0)
    found = errors(lambda seed: debias(toy, rmse=0.02, method=method, seed=seed), toy.exact_value, 20)
    assert 0.5 < math.sqrt(np.mean(found**2)) / 0.02 < 1.3  # aim 0.89, standard error 0.14


def test_the_best_distribution_beats_a_geometric_one() -> None:
    toy = NormalLevels(1.0, 2.0)
    best = debias(toy, n=40_000, seed=1)
    plain = debias(toy, n=40_000, distribution=LevelDistribution.geometric(1.5), seed=1)
    work = [estimate.standard_error**2 * estimate.cost for estimate in (best, plain)]
    assert work[0] < work[1]


def test_debiased_estimates_merge() -> None:
    parts = [debias(NormalLevels(1.0, 2.0), n=5000, seed=seed) for seed in (1, 2)]
    assert parts[0].merge(parts[1]).n == 10_000
    with pytest.raises(ValueError, match="same points"):
        parts[0].merge(parts[0])


@pytest.mark.parametrize(
    ("sampler", "arguments", "message"),
    [
        (NormalLevels(0.5, 1.0), {}, r"beta > gamma is needed"),
        (NormalLevels(1.0, 2.0), {"distribution": LevelDistribution.geometric(2.5)}, "variance .* infinite"),
        (NormalLevels(1.0, 2.0), {"distribution": LevelDistribution.geometric(0.5)}, "cost .* infinite"),
        (NormalLevels(1.0, 2.0), {"distribution": LevelDistribution((1.0, 0.5), 0.0)}, "has a last level"),
        (NormalLevels(1.0, 2.0), {"method": "coupled"}, "needs a sampler with the method 'ladder'"),
        (NormalLevels(1.0, 2.0), {"method": "double"}, "unknown method"),
        (NormalLevels(1.0, 2.0), {"rmse": 0.1}, "either n"),
        (FunctionSampler(lambda level, u: (u, u), max_level=3), {}, "is not exact"),
    ],
)
def test_debiasing_refuses_with_reasons(sampler: Any, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        debias(sampler, n=100, **arguments)
