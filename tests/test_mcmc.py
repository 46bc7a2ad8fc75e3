"""Markov kernels: laws that run on every member, exact moments, refusals."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import special, stats

from evenlight import mcmc
from evenlight.importance import StudentT
from evenlight.mcmc import (
    HMC,
    KERNELS,
    LFSR,
    MALA,
    DelayedRejection,
    Gibbs,
    HerdedGibbs,
    Independence,
    Info,
    MetropolisHastings,
    Microcanonical,
    MultipleTry,
    ParallelTempering,
    PrimarySampleSpace,
    Proposal,
    RandomWalk,
    Slice,
)


def banana(x: Any) -> Any:
    """x_1 is standard normal, x_2 = x_1^2 - 1 + z / 2 with z standard normal."""
    return -0.5 * (x[:, 0] ** 2 + 4 * (x[:, 1] - x[:, 0] ** 2 + 1) ** 2)


def banana_gradient(x: Any) -> Any:
    z = 4 * (x[:, 1] - x[:, 0] ** 2 + 1)
    return np.stack([-x[:, 0] + 2 * z * x[:, 0], -z], axis=1)


def to_banana(z: np.ndarray) -> np.ndarray:
    return np.stack([z[:, 0], z[:, 0] ** 2 - 1 + 0.5 * z[:, 1]], axis=1)


def from_banana(x: np.ndarray) -> np.ndarray:
    return np.stack([x[:, 0], 2 * (x[:, 1] - x[:, 0] ** 2 + 1)], axis=1)


SHIFTED_STEP = Proposal(  # neither symmetric nor centered
    2,
    lambda x, u: 0.9 * x + 0.05 + 0.7 * special.ndtri(u),
    lambda y, x: -0.5 * (((y - 0.9 * x - 0.05) / 0.7) ** 2).sum(axis=1),
)
BETAS = (1.0, 0.5, 0.2)


def within(log_density: Any, beta: float) -> RandomWalk:
    return RandomWalk(log_density, scale=0.8 / beta**0.5)


RHO = 0.6
CORRELATED = Gibbs(
    [
        lambda x, u: RHO * x[:, 1] + (1 - RHO**2) ** 0.5 * special.ndtri(u),
        lambda x, u: RHO * x[:, 0] + (1 - RHO**2) ** 0.5 * special.ndtri(u),
    ]
)


WRONG: Any = 3
ORIGIN = np.zeros((4, 2))
HERDED = (HerdedGibbs(lambda x, j: x[:, 0]).init(ORIGIN), np.empty((4, 0)))


@dataclass(frozen=True)
class Case:
    """A kernel, and the map between its target and two independent standard normals, both ways."""

    kernel: Any
    to_target: Any = to_banana
    from_target: Any = from_banana
    start: tuple[float, float] = (1.5, 1.0)

    def exact_start(self, rng: np.random.Generator, rows: int) -> Any:
        """A state in equilibrium: for tempering, at every temperature (a power of a normal is a wider normal)."""
        state = self.kernel.init(self.to_target(rng.normal(size=(rows, 2))))
        if not isinstance(self.kernel, ParallelTempering):
            return state
        hotter = [self.to_target(rng.normal(size=(rows, 2)) / beta**0.5) for beta in BETAS[1:]]
        levels = [RandomWalk(banana).init(x) for x in (state.position, *hotter)]
        return replace(state, levels=tuple(levels))


CASES = {
    "random_walk": Case(RandomWalk(banana, scale=0.8, covariance=[[1.0, 0.2], [0.2, 1.5]])),
    "independence": Case(Independence(banana, StudentT([0.0, 0.5], [[1.5, 0.0], [0.0, 3.0]], df=4))),
    "metropolis_hastings": Case(MetropolisHastings(banana, SHIFTED_STEP)),
    "gibbs": Case(
        CORRELATED,
        lambda z: np.stack([z[:, 0], RHO * z[:, 0] + (1 - RHO**2) ** 0.5 * z[:, 1]], axis=1),
        lambda x: np.stack([x[:, 0], (x[:, 1] - RHO * x[:, 0]) / (1 - RHO**2) ** 0.5], axis=1),
    ),
    "hmc": Case(HMC(banana, banana_gradient, step_size=0.15, steps=12, covariance=[1.0, 1.5])),
    "mala": Case(MALA(banana, banana_gradient, step_size=0.5, covariance=[[1.0, -0.2], [-0.2, 1.2]])),
    "microcanonical": Case(
        Microcanonical(
            banana, banana_gradient, step_size=0.6, steps=12, decades=1.0, covariance=[[1.0, 0.3], [0.3, 1.5]]
        )
    ),
    "slice": Case(Slice(banana, width=[1.0, 2.0], steps_out=3, tries=6)),
    "parallel_tempering": Case(ParallelTempering(banana, within, BETAS)),
    "delayed_rejection": Case(DelayedRejection(banana, scale=1.5, shrink=0.3)),
    "multiple_try": Case(MultipleTry(banana, tries=4, scale=1.2)),
    "primary_sample_space": Case(  # Beta(2, 1) and Beta(3, 1)
        PrimarySampleSpace(lambda u: np.log(u[:, 0]) + 2 * np.log(u[:, 1]), large_step=0.4),
        lambda z: special.ndtr(z) ** np.array([1 / 2, 1 / 3]),
        lambda u: special.ndtri(u ** np.array([2, 3])),
        (0.9, 0.9),
    ),
}
DETERMINISTIC = {"herded_gibbs"}


def draws(chains: mcmc.Chains) -> np.ndarray:
    assert chains.draws is not None
    return chains.draws


def worst_p_value(case: Case, steps: int = 6, rows: int = 20_000) -> float:
    """From exact draws of the target some steps on: Kolmogorov and Smirnov's p-values of three projections."""
    rng = np.random.default_rng(8)
    state = case.exact_start(rng, rows)
    for _ in range(steps):
        state, _ = case.kernel.step(state, rng.uniform(size=(rows, case.kernel.dims(2))))
    z = case.from_target(state.position)
    return min(float(stats.kstest(p, "norm").pvalue) for p in (z[:, 0], z[:, 1], (z[:, 0] - z[:, 1]) / 2**0.5))


def test_every_kernel_has_a_case_and_every_file_is_registered() -> None:
    assert set(CASES) | DETERMINISTIC == set(KERNELS)
    folder = Path(inspect.getfile(mcmc.kernels)).parent
    assert {path.stem for path in folder.glob("*.py")} - {"__init__"} == set(KERNELS)


@pytest.mark.parametrize("name", CASES)
def test_kernels_leave_their_target_invariant(name: str) -> None:
    """The chains are independent and begin in the target: a false alarm in 3,000 for each kernel."""
    assert worst_p_value(CASES[name]) > 1e-4


def test_the_law_of_invariance_finds_a_wrong_acceptance() -> None:
    @dataclass(frozen=True, eq=False)
    class TooGenerous(RandomWalk):
        def step(self, state: Any, uniforms: Any) -> Any:
            return super().step(state, np.concatenate([uniforms[:, :-1], 0.8 * uniforms[:, -1:]], axis=1))

    assert worst_p_value(Case(TooGenerous(banana, scale=0.8))) < 1e-9


def exponential(x: Any) -> Any:
    return np.where(x[:, 0] > 0, -x[:, 0], -np.inf)


def minus_one(x: Any) -> Any:
    return -np.ones_like(x)


@pytest.mark.parametrize(
    "kernel",
    [
        RandomWalk(exponential, scale=2.0),
        Independence(exponential, StudentT([0.0], df=3)),
        MetropolisHastings(exponential, Proposal(1, lambda x, u: x + 3 * u - 1.5)),
        HMC(exponential, minus_one, step_size=0.3, steps=5, randomize=False),
        MALA(exponential, minus_one, step_size=1.0),
        Slice(exponential, width=0.7, steps_out=4, tries=3),
        DelayedRejection(exponential, scale=3.0, shrink=0.5),
        MultipleTry(exponential, tries=3, scale=2.0),
    ],
    ids=lambda kernel: kernel.name,
)
def test_the_edge_of_a_target_is_respected(kernel: Any) -> None:
    """Exponential from exact draws: Kolmogorov and Smirnov, a false alarm in 10,000 for each kernel."""
    rng = np.random.default_rng(4)
    state = kernel.init(rng.exponential(size=(20_000, 1)))
    for _ in range(6):
        state, _ = kernel.step(state, rng.uniform(size=(20_000, kernel.dims(1))))
    assert state.position.min() > 0
    assert stats.kstest(state.position[:, 0], "expon").pvalue > 1e-4


@pytest.mark.parametrize("name", CASES)
def test_kernels_forget_where_they_start(name: str) -> None:
    """Means of 64 chains within 5 standard errors: a false alarm in 50,000 for each of 4 functions."""
    kernel = CASES[name].kernel
    chains = mcmc.run(kernel, CASES[name].start, n=600, chains=64, burn_in=150, seed=3)
    estimate = chains.estimate(lambda x: np.concatenate([f := CASES[name].from_target(x), f**2], axis=1))
    assert (np.abs(estimate.value - [0, 0, 1, 1]) < 5 * estimate.standard_error).all()
    assert (estimate.standard_error < 0.12).all()
    assert 0.1 < chains.acceptance.mean() <= 1


@pytest.mark.parametrize("name", CASES)
def test_chains_are_treated_each_by_itself_and_deterministically(name: str) -> None:
    kernel = CASES[name].kernel
    rng = np.random.default_rng(5)
    start, uniforms = CASES[name].to_target(rng.normal(size=(50, 2))), rng.uniform(size=(50, kernel.dims(2)))
    together, info = kernel.step(kernel.init(start), uniforms)
    order = rng.permutation(50)[:20]
    apart, apart_info = kernel.step(kernel.init(start[order]), uniforms[order])
    np.testing.assert_allclose(apart.position, together.position[order], rtol=1e-12)
    assert isinstance(info, Info)
    assert all(len(column) == 50 for column in info.columns().values())
    np.testing.assert_allclose(apart_info.acceptance, info.acceptance[order], rtol=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_the_same_seed_gives_the_same_bits(name: str) -> None:
    kernel = CASES[name].kernel
    one, same, other = (draws(mcmc.run(kernel, [0.5, 0.5], n=40, warm_up=50, burn_in=5, seed=s)) for s in (1, 1, 2))
    assert (one == same).all()
    assert not (one == other).all()


@pytest.mark.parametrize("name", CASES)
def test_a_run_that_goes_on_has_the_bits_of_one_long_run(name: str) -> None:
    kernel = CASES[name].kernel
    functionals = {"x": lambda x: x}
    settings: dict[str, Any] = {"warm_up": 50, "burn_in": 5, "functionals": functionals, "seed": 1}
    whole = mcmc.run(kernel, [0.5, 0.5], n=40, **settings)
    parts = mcmc.run(kernel, [0.5, 0.5], n=17, **settings)
    parts = mcmc.run(kernel, [0.5, 0.5], n=40, resume=parts, **settings)
    assert (draws(parts) == draws(whole)).all()
    assert all(np.array_equal(parts.info[key], whole.info[key], equal_nan=True) for key in whole.info)
    assert (parts.means["x"] == whole.means["x"]).all()
    assert parts.estimate("x").to_dict() == whole.estimate("x").to_dict()


def test_a_warm_up_finds_scale_and_covariance_and_then_freezes() -> None:
    """A 10-dimensional normal with deviations 1 to 10 and correlation 1/2, from a step 100 times too small."""
    deviations = np.arange(1.0, 11.0)
    covariance = deviations[:, None] * deviations * (0.5 + 0.5 * np.eye(10))
    inverse = np.linalg.inv(covariance)
    kernel = RandomWalk(lambda x: -0.5 * ((x @ inverse) * x).sum(axis=1), scale=0.01)
    chains = mcmc.run(kernel, np.zeros(10), n=1500, chains=16, warm_up=3000, seed=2)
    assert 0.2 < chains.acceptance.mean() < 0.3
    found = chains.kernel.scale**2 * chains.kernel.covariance
    np.testing.assert_allclose(np.diag(found) / deviations**2, 2.38**2 / 10, rtol=0.5)
    assert 0.3 < found[0, 9] / np.sqrt(found[0, 0] * found[9, 9]) < 0.7
    assert kernel.scale == 0.01


@pytest.mark.parametrize("kernel", [HMC, MALA])
def test_a_warm_up_finds_the_step_size(kernel: Any) -> None:
    deviations = np.array([0.01, 1.0, 10.0])
    start = kernel(lambda x: -0.5 * ((x / deviations) ** 2).sum(axis=1), lambda x: -x / deviations**2, step_size=0.001)
    chains = mcmc.run(start, np.zeros(3), n=200, chains=16, warm_up=1000, seed=2)
    wanted = {"hmc": 0.8, "mala": 0.574}[kernel.name]
    assert abs(chains.acceptance.mean() - wanted) < 0.08
    np.testing.assert_allclose(np.sqrt(np.diag(chains.kernel.covariance)) / deviations, 1, rtol=0.3)


def test_finite_differences_are_gradients() -> None:
    x = np.random.default_rng(1).normal(size=(30, 2))
    found = mcmc.gradients.with_gradient(banana, "finite-differences")[1](x)
    np.testing.assert_allclose(found, banana_gradient(x), rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: RandomWalk(WRONG), TypeError, "log_density must be a function"),
        (lambda: RandomWalk(banana, scale=-1.0), ValueError, "scale must be finite and above 0"),
        (lambda: RandomWalk(banana, covariance=[[1, 2], [2, 1]]), ValueError, "not positive definite"),
        (lambda: HMC(banana, "guess"), ValueError, "unknown gradient 'guess'; known: finite-differences, jax, torch"),
        (lambda: HMC(banana, WRONG), TypeError, "'finite-differences' works with every log density"),
        (lambda: HMC(banana, banana_gradient, steps=0), ValueError, "steps must be at least 1"),
        (
            lambda: Microcanonical(banana, banana_gradient, decades=-1.0),
            ValueError,
            "decades must be finite and",
        ),
        (lambda: Microcanonical(exponential, minus_one).init(np.ones((4, 1))), ValueError, "at least 2 dimensions"),
        (lambda: MetropolisHastings(banana, WRONG), TypeError, "proposal must be a Proposal"),
        (lambda: Slice(banana, width=[1.0, -1.0]), ValueError, "width must be finite and above 0"),
        (lambda: DelayedRejection(banana, shrink=1.0), ValueError, "shrink must be between 0 and 1"),
        (lambda: MultipleTry(banana, tries=1), ValueError, "tries must be at least 2"),
        (lambda: ParallelTempering(banana, within, [1, 1]), ValueError, "must fall from 1"),
        (lambda: ParallelTempering(banana, lambda f, b: CORRELATED, [1, 0.5]).init(ORIGIN), TypeError, "log density"),
        (lambda: PrimarySampleSpace(banana, large_step=0.0), ValueError, "large_step must be above 0"),
        (lambda: PrimarySampleSpace(banana, smallest=0.1), ValueError, "0 < smallest <= largest"),
        (lambda: PrimarySampleSpace(banana).init(ORIGIN + 1), ValueError, r"chain 0 starts at \[1.0, 1.0\], outside"),
        (lambda: HerdedGibbs(lambda x, j: 0 * x[:, 0]).init(ORIGIN + 0.5), ValueError, "zeros and ones"),
        (lambda: HerdedGibbs(lambda x, j: 2 + x[:, 0]).step(*HERDED), ValueError, "4 probabilities"),
        (lambda: HerdedGibbs(lambda x, j: 2 + x[:, 0]).dims(17), ValueError, "at most 16 variables"),
        (lambda: Gibbs([]), ValueError, "one function for each coordinate"),
        (lambda: mcmc.run(CORRELATED, [0.0], n=5), ValueError, "2 conditionals, the chains have 1"),
        (lambda: mcmc.run(CORRELATED, [[0.0, 0.0]], n=5, chains=2), ValueError, "1 starts for 2 chains"),
        (lambda: mcmc.run(CORRELATED, [0.0, 0.0]), ValueError, "n, the number of steps, must be given"),
        (lambda: mcmc.run(CORRELATED, [0.0, np.nan], n=5), ValueError, "positions must be finite"),
        (lambda: mcmc.run(CORRELATED, [0.0, 0.0], n=5, points=LFSR(10)), ValueError, "1024 steps"),
        (lambda: mcmc.run(CORRELATED, [0.0, 0.0], n=5, points=WRONG), TypeError, "points must be a driving sequence"),
        (lambda: mcmc.run(RandomWalk(lambda x: x), [0.0], n=5), ValueError, r"shape \(4,\) for 4 rows"),
        (lambda: mcmc.run(RandomWalk(lambda x: np.sqrt(-x[:, 0])), [0.0], n=5), ValueError, "log_density is nan at"),
        (lambda: mcmc.run(RandomWalk(lambda x: np.log(x[:, 0])), [0.0], n=5), ValueError, "density is 0"),
        (lambda: LFSR(9), ValueError, "m must be at least 10"),
        (lambda: LFSR(17, "harase"), ValueError, "'harase' has m = 10 to 16, not 17"),
    ],
)
def test_what_cannot_work_is_refused(call: Any, error: type[Exception], words: str) -> None:
    with np.errstate(invalid="ignore", divide="ignore"), pytest.raises(error, match=words):
        call()


def test_estimates_come_from_chains_and_merge_only_when_independent() -> None:
    runs = [mcmc.run(CORRELATED, [0.0, 0.0], n=50, chains=6, seed=seed) for seed in (1, 2)]
    one, two = (chains.estimate(lambda x: x[:, 0]) for chains in runs)
    assert (one.n, one.replicates, one.degrees_of_freedom) == (300, 6, 5)
    means = draws(runs[0])[:, :, 0].mean(axis=1)
    assert one.value == pytest.approx(means.mean())
    assert one.standard_error == pytest.approx(means.std(ddof=1) / 6**0.5)
    assert one.merge(two).replicates == 12
    with pytest.raises(ValueError, match="the same points"):
        one.merge(one)
    single = mcmc.run(CORRELATED, [0.0, 0.0], n=50, chains=1, seed=1).estimate(lambda x: x[:, 0])
    assert np.isnan(single.standard_error)


def test_functionals_need_no_draws() -> None:
    kept = mcmc.run(CORRELATED, [0.0, 0.0], n=30, seed=4)
    lean = mcmc.run(CORRELATED, [0.0, 0.0], n=30, seed=4, functionals={"x": lambda x: x}, keep_draws=False)
    assert lean.draws is None
    np.testing.assert_allclose(lean.estimate("x").value, kept.estimate(lambda x: x).value, rtol=1e-12)
    with pytest.raises(ValueError, match="kept no draws"):
        lean.estimate(lambda x: x)
    with pytest.raises(ValueError, match="no functional 'y' in this run; known: x"):
        lean.estimate("y")


def test_herded_gibbs_converges_as_one_over_t() -> None:
    """Ten fully connected models of 4 variables: T times the total variation stays below 20."""
    rng = np.random.default_rng(11)
    couplings = rng.normal(size=(10, 4, 4))
    couplings = couplings + couplings.transpose(0, 2, 1)
    couplings[:, range(4), range(4)] = 0
    biases = rng.normal(size=(10, 4))

    def conditional(x: Any, j: int) -> Any:
        return special.expit((couplings[:, j] * x).sum(axis=1) + biases[:, j])

    states = (np.arange(16)[:, None] >> np.arange(4)) & 1
    energies = 0.5 * np.einsum("si,kij,sj->ks", states, couplings, states) + biases @ states.T
    exact = special.softmax(energies, axis=1)
    chains = mcmc.run(HerdedGibbs(conditional), np.zeros((10, 4)), n=3000)
    estimate = chains.estimate(lambda x: x)
    assert np.isnan(estimate.standard_error).all()  # chains of the same start are the same
    assert estimate.replicates == 1
    codes = (draws(chains) @ (2 ** np.arange(4))).astype(int)
    for steps in (300, 1000, 3000):
        found = np.stack([np.bincount(chain[:steps], minlength=16) / steps for chain in codes])
        assert (steps * 0.5 * np.abs(found - exact).sum(axis=1) <= 20).all()


def test_tempering_swaps_and_finds_both_modes() -> None:
    def modes(x: Any) -> Any:
        return np.logaddexp(-0.5 * (x[:, 0] - 8) ** 2, np.log(3) - 0.5 * (x[:, 0] + 8) ** 2)

    kernel = ParallelTempering(modes, lambda f, beta: RandomWalk(f, scale=2 / beta**0.5), [1, 0.3, 0.1, 0.03])
    chains = mcmc.run(kernel, [8.0], n=1000, chains=32, burn_in=300, seed=1)
    estimate = chains.estimate(lambda x: x[:, 0] > 0)
    assert abs(estimate.value - 0.25) < 4.5 * estimate.standard_error < 0.2
    swaps = chains.info["swaps"]
    assert swaps.shape == (32, 1000, 3)
    assert np.isnan(swaps[:, 0]).tolist() == [[False, True, False]] * 32
    assert np.isnan(swaps[:, 1]).tolist() == [[True, False, True]] * 32
