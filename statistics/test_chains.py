"""Longer tests of chains: coverage of intervals, published models driven by evenly spread numbers, the funnel."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from arviz_stats.base import array_stats
from scipy import integrate, special, stats

from evenlight.mcmc import (
    HMC,
    LCG,
    LFSR,
    NUTS,
    Antithetic,
    Gibbs,
    HerdedGibbs,
    MetropolisHastings,
    Microcanonical,
    Permuted,
    Proposal,
    RandomWalk,
    Stratified,
    run,
)
from evenlight.points import Sobol

pytestmark = pytest.mark.timeout(600)  # a minute each on a quiet processor


def correlated(rho: float) -> Gibbs:
    rest = (1 - rho * rho) ** 0.5
    return Gibbs(
        [
            lambda x, u: rho * x[:, 1] + rest * special.ndtri(u),
            lambda x, u: rho * x[:, 0] + rest * special.ndtri(u),
        ]
    )


MOMENTS: dict[str, Any] = {
    "x1": lambda x: x[:, 0],
    "x1 x2": lambda x: x[:, 0] * x[:, 1],
    "x1^2": lambda x: x[:, 0] ** 2,
    "x1 > 1": lambda x: (x[:, 0] > 1).astype(float),
}
EXACT = {"x1": 0.0, "x1 x2": 0.5, "x1^2": 1.0, "x1 > 1": stats.norm.sf(1)}


@pytest.mark.parametrize(
    "points", [None, LFSR(10), LCG(10), Permuted(Sobol(2)), Antithetic(), Stratified(4)], ids=lambda p: p and p.name
)
def test_intervals_from_repetitions_cover(points: Any) -> None:
    """400 groups of 8 repetitions.

    The count's own standard error is 1.1 %: three of them, and 0.5 % for the finite chains' bias and odd repetitions.
    """
    coupled = 1 if points is None else points.coupled
    n = 1024 if points is None or points.length(2) is None else None
    settings: dict[str, Any] = {"functionals": MOMENTS, "keep_draws": False, "burn_in": 20, "seed": 5}
    chains = run(correlated(0.5), [0, 0], n=n, points=points, chains=3200 * coupled, **settings)
    for functional in ("x1 x2", "x1 > 1"):
        means = chains.means[functional].reshape(400, 8, coupled).mean(axis=2)
        errors = means.std(axis=1, ddof=1) / 8**0.5
        covered = np.abs(means.mean(axis=1) - EXACT[functional]) < stats.t.ppf(0.975, 7) * errors
        assert 0.91 < covered.mean() < 0.99


# Reduction of the variance of a mean by m and table, 200 randomizations, each ± a factor of 1.5: reference values.
PUBLISHED = {
    ("chen", 10): (545, 132, 161, 9),
    ("harase", 10): (3.7e3, 370, 330, 9),
    ("harase", 12): (1.2e4, 1.4e3, 830, 15),
    ("chen", 16): (3.1e4, 4.4e3, 6.3e3, 23),
}


@pytest.mark.parametrize(("table", "m"), PUBLISHED)
def test_variance_reductions_on_the_bivariate_normal(table: str, m: int) -> None:
    """The reference's figures and ours, of 200 repetitions each, are known to a factor of 1.5: within twice that."""
    settings: dict[str, Any] = {"chains": 200, "functionals": MOMENTS, "keep_draws": False}
    even = run(correlated(0.5), [0, 0], points=LFSR(m, table), seed=1, **settings)
    random = run(correlated(0.5), [0, 0], n=2 ** min(m, 12), seed=2, **settings)
    scale = 2 ** (m - min(m, 12))  # the variance of independent numbers falls as 1 / n
    for name, published in zip(MOMENTS, PUBLISHED[table, m], strict=True):
        squares = [np.mean((chains.means[name] - EXACT[name]) ** 2) for chains in (random, even)]
        assert published / 2.25 < squares[0] / scale / squares[1] < published * 2.25


FAILURES = np.array([5, 1, 5, 14, 3, 19, 1, 1, 4, 22.0])
TIMES = np.array([94.320, 15.720, 62.880, 125.760, 5.240, 31.440, 1.048, 1.048, 2.096, 10.480])
SHAPE, BETA_SHAPE, BETA_RATE = 1.802, 0.01, 1.0


def pumps() -> tuple[Gibbs, np.ndarray]:
    """Failures of ten pumps (D. P. Gaver and I. G. O'Muircheartaigh 1987): the sampler, exact posterior means."""

    def rate(j: int) -> Any:
        return lambda x, u: special.gammaincinv(SHAPE + FAILURES[j], u) / (TIMES[j] + x[:, 10])

    def beta(x: Any, u: Any) -> Any:
        return special.gammaincinv(BETA_SHAPE + 10 * SHAPE, u) / (BETA_RATE + x[:, :10].sum(axis=1))

    def log_density(b: float) -> float:
        prior = (BETA_SHAPE - 1 + 10 * SHAPE) * np.log(b) - BETA_RATE * b
        return float(prior - ((SHAPE + FAILURES) * np.log(TIMES + b)).sum())

    def mean(f: Any) -> float:
        peak = log_density(2.4)
        parts = [
            integrate.quad(lambda b, g=g: g(b) * np.exp(log_density(b) - peak), 0, 60, epsabs=0, epsrel=1e-11)[0]
            for g in (f, lambda b: 1.0)
        ]
        return float(parts[0] / parts[1])

    rates = [(SHAPE + FAILURES[j]) * mean(lambda b, j=j: 1 / (TIMES[j] + b)) for j in range(10)]
    return Gibbs([*[rate(j) for j in range(10)], beta]), np.array([*rates, mean(lambda b: b)])


@pytest.mark.parametrize(("points", "least"), [(LFSR(10), 100), (LFSR(10, "chen"), 60), (LCG(10), 8)])
def test_variance_reductions_on_the_pumps(points: Any, least: float) -> None:
    """Eleven numbers a step, n = 1024, 100 repetitions: all posterior means within 4.5 standard errors.

    Every variance is reduced by so much at least; measured were 180 to 6,500, 150 to 700, and 14 to 240.
    """
    kernel, exact = pumps()
    settings: dict[str, Any] = {"chains": 100, "burn_in": 10, "functionals": {"x": lambda x: x}, "keep_draws": False}
    even = run(kernel, exact, points=points, seed=1, **settings)
    random = run(kernel, exact, n=points.length(11), seed=2, **settings)
    estimate = even.estimate("x")
    assert (np.abs(estimate.value - exact) < 4.5 * estimate.standard_error).all()
    reductions = np.mean((random.means["x"] - exact) ** 2, axis=0) / np.mean((even.means["x"] - exact) ** 2, axis=0)
    assert reductions.min() > least


def test_metropolis_on_a_finite_space_converges_when_driven_by_registers() -> None:
    """What is proven (Owen and Tribble 2005): errors fall with m.

    Here they are well below those of independent numbers: measured were factors of 16, 11 and 9 in the mean square.
    """
    weights = np.log(np.arange(1, 9))

    def log_density(x: Any) -> Any:
        return np.where((x[:, 0] >= 0) & (x[:, 0] < 8), weights[np.clip(x[:, 0], 0, 7).astype(int)], -np.inf)

    kernel = MetropolisHastings(log_density, Proposal(1, lambda x, u: x + np.where(u < 0.5, -1.0, 1.0)))
    exact = float(np.arange(8) @ np.arange(1, 9)) / 36
    settings: dict[str, Any] = {"chains": 200, "burn_in": 100, "functionals": {"x": lambda x: x[:, 0]}}
    before = float("inf")
    for m in (10, 12, 14):
        even, random = (
            float(
                np.mean(
                    (run(kernel, [6.0], n=2**m, points=points, keep_draws=False, **settings).means["x"] - exact) ** 2
                )
            )
            for points in (LFSR(m), None)
        )
        assert even < 0.25 * random
        assert even < 0.5 * before
        before = even


def test_herded_gibbs_keeps_its_rate() -> None:
    """Ten fully connected models of 4 variables: T times the total variation is at most 20 up to T = 30,000."""
    rng = np.random.default_rng(11)
    couplings = rng.normal(size=(10, 4, 4))
    couplings = couplings + couplings.transpose(0, 2, 1)
    couplings[:, range(4), range(4)] = 0
    biases = rng.normal(size=(10, 4))
    states = (np.arange(16)[:, None] >> np.arange(4)) & 1
    energies = 0.5 * np.einsum("si,kij,sj->ks", states, couplings, states) + biases @ states.T
    exact = special.softmax(energies, axis=1)

    def conditional(x: Any, j: int) -> Any:
        return special.expit((couplings[:, j] * x).sum(axis=1) + biases[:, j])

    codes = (run(HerdedGibbs(conditional), np.zeros((10, 4)), n=30_000).kept_draws() @ (2 ** np.arange(4))).astype(int)
    for steps in (300, 1000, 3000, 10_000, 30_000):
        found = np.stack([np.bincount(chain[:steps], minlength=16) / steps for chain in codes])
        assert (steps * 0.5 * np.abs(found - exact).sum(axis=1) <= 20).all()


COVARIANCE = 0.9 ** np.abs(np.subtract.outer(np.arange(10), np.arange(10)))
INVERSE = np.linalg.inv(COVARIANCE)


def check_normal(chains: Any) -> None:
    """Means, variances and neighbors' products within 4 MCSE, 29 numbers: a false alarm in 500."""
    draws = chains.kept_draws()
    functionals: list[tuple[Any, float]] = [
        (lambda x: x, 0.0),
        (np.square, 1.0),
        (lambda x: x[..., 1:] * x[..., :-1], 0.9),
    ]
    for functional, exact in functionals:
        errors = chains.diagnostics(functional).mcse_mean
        assert (np.abs(functional(draws).mean(axis=(0, 1)) - exact) < 4 * errors).all()
        assert errors.max() < 0.06
    assert chains.diagnostics().r_hat.max() < 1.02


def normal(x: Any) -> Any:
    return -0.5 * ((x @ INVERSE) * x).sum(axis=1)


def normal_gradient(x: Any) -> Any:
    return -x @ INVERSE


def test_hmc_and_nuts_agree_with_a_correlated_normal() -> None:
    """Ten dimensions, correlations 0.9^|i - j|."""
    check_normal(
        run(HMC(normal, normal_gradient, step_size=0.2, steps=20), np.zeros(10), n=2000, chains=8, warm_up=500)
    )
    check_normal(NUTS(normal, normal_gradient).run(np.zeros(10), n=2000, chains=4, warm_up=500, seed=1))


def test_a_random_walk_agrees_with_a_correlated_normal() -> None:
    check_normal(run(RandomWalk(normal), np.zeros(10), n=10_000, chains=16, warm_up=2000, seed=2))


def funnel(x: Any) -> Any:
    """R. M. Neal's (2003): v is normal with deviation 3, nine others are normal with variance exp(v)."""
    v = x[:, 0]
    return -(v**2) / 18 - 0.5 * (x[:, 1:] ** 2).sum(axis=1) * np.exp(-v) - 4.5 * v


def funnel_gradient(x: Any) -> Any:
    v, inverse = x[:, 0], np.exp(-x[:, 0])
    of_v = -v / 9 + 0.5 * (x[:, 1:] ** 2).sum(axis=1) * inverse - 4.5
    return np.column_stack([of_v, -x[:, 1:] * inverse[:, None]])


def to_funnel(z: Any) -> Any:
    """From standard normals, which are its coordinates without a center."""
    v = 3 * z[:, :1]
    return np.concatenate([v, np.exp(v / 2) * z[:, 1:]], axis=1)


def standard_normal(z: Any) -> Any:
    return -0.5 * (z**2).sum(axis=1)


def minus(z: Any) -> Any:
    return -z


def check_funnel(found: Any, draws: Any) -> None:
    """No doubts: all R-hat at most 1.01, bulk and tail ESS at least 400, no divergence. And v is right.

    Five quantiles of v within 4 MCSE: a false alarm in 3,000.
    """
    assert found.doubts == ()
    assert found.r_hat.max() < 1.01
    assert min(found.ess_bulk.min(), found.ess_tail.min()) > 400
    v = draws.reshape(*draws.shape[:2], -1)[:, :, 0]
    for p in (0.05, 0.25, 0.5, 0.75, 0.95):
        error = float(array_stats.mcse(v, chain_axis=0, draw_axis=1, method="quantile", prob=p))
        assert abs(np.quantile(v, p) - 3 * stats.norm.ppf(p)) < 4 * error < 1.0


def test_microcanonical_chains_mix_on_the_funnel() -> None:
    """As R. M. Neal wrote it. All chains start at v = 0."""
    start = np.random.default_rng(0).normal(size=(24, 10)) * (np.arange(10) > 0)
    chains = run(Microcanonical(funnel, funnel_gradient, steps=300), start, n=1200, burn_in=100, seed=1)
    check_funnel(chains.diagnostics(), chains.kept_draws())


@pytest.mark.parametrize("sampler", ["hmc", "nuts"])
def test_hmc_and_nuts_mix_on_the_funnel_without_a_center(sampler: str) -> None:
    """In coordinates whose scale is the same everywhere, and mapped back."""
    if sampler == "hmc":
        kernel = HMC(standard_normal, minus, step_size=0.3, steps=10)
        chains = run(kernel, np.zeros(10), n=1000, chains=8, burn_in=50, seed=1)
    else:
        chains = NUTS(standard_normal, minus).run(np.zeros(10), n=1500, chains=4, warm_up=300, seed=1)
    draws = chains.kept_draws()
    mapped = to_funnel(draws.reshape(-1, 10)).reshape(draws.shape)
    check_funnel(chains.diagnostics(to_funnel), mapped)


def test_hmc_and_nuts_on_the_centered_funnel_say_that_they_are_not_to_be_trusted() -> None:
    """Their quantiles agree with the exact ones, by large errors: R-hat, the worth of draws and divergences tell."""
    start = np.random.default_rng(0).normal(size=(20, 10)) * (np.arange(10) > 0)
    small = run(HMC(funnel, funnel_gradient, step_size=0.05, steps=100), start, n=300, burn_in=50, seed=1)
    usual = NUTS(funnel, funnel_gradient).run(np.full(10, 0.1), n=500, chains=4, warm_up=300, seed=1)
    for chains in (small, usual):
        doubts = " ".join(chains.diagnostics().doubts)
        assert "R-hat is" in doubts
        assert "fewer than 400" in doubts
        estimate = chains.estimate(lambda x: x[:, 0])
        assert not estimate.converged
        assert "the chains disagree" in estimate.message
    assert "trajectories diverged" in usual.estimate(lambda x: x[:, 0]).message
