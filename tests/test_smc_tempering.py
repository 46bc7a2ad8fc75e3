"""Tempering against exact normalizing constants: a normal posterior, two far modes, a bounded prior."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy import stats

from evenlight import smc
from evenlight.importance import Normal

WIDE = Normal(np.zeros(4))
NARROW = Normal(np.full(4, 1.0), 0.02)
EVIDENCE = float(Normal(np.zeros(4), 1.02).logpdf(np.full((1, 4), 1.0))[0])


@pytest.mark.parametrize("waste_free", [True, False])
@pytest.mark.parametrize("temperatures", [None, [0.01, 0.05, 0.2, 0.5, 1.0]])
def test_a_normal_posterior(waste_free: bool, temperatures: Any) -> None:
    """16 replicates: z of the evidence below 5 (Student's t of 15: 1.6e-4), of four means below 6.

    The bias of order 1 / particles is a tenth of the standard error and hides in this.
    """
    particles, moves = (1280, 31) if waste_free else (256, 8)
    evidence = smc.temper(
        WIDE,
        NARROW.logpdf,
        particles=particles,
        moves=moves,
        waste_free=waste_free,
        temperatures=temperatures,
        replicates=16,
        seed=1,
    )
    assert abs(evidence.value - EVIDENCE) < 5 * evidence.standard_error < 0.5
    deviations = (evidence.diagnostics["means"] - 1 / 1.02) / evidence.diagnostics["standard_errors"]
    assert np.abs(deviations).max() < 6
    path = evidence.diagnostics["temperatures"]
    assert path[-1] == 1.0
    assert (np.diff(path) > 0).all()
    if temperatures is not None:
        assert path == temperatures
    assert 0.1 < evidence.diagnostics["acceptance"][-1] < 0.5


def test_two_far_modes_keep_their_shares() -> None:
    """0.25 of the mass around 5, the rest around -5: a single walk would never cross."""
    right, left = Normal([5.0, 0.0], 0.05), Normal([-5.0, 0.0], 0.05)

    def log_likelihood(x: Any) -> Any:
        return np.logaddexp(math.log(0.25) + right.logpdf(x), math.log(0.75) + left.logpdf(x))

    evidence = smc.temper(
        Normal([0.0, 0.0], 9.0),
        log_likelihood,
        particles=1024,
        moves=15,
        function=lambda x: x[:, 0] > 0,
        replicates=16,
        seed=2,
    )
    truth = float(Normal([0.0, 0.0], 9.05).logpdf(np.array([[5.0, 0.0]]))[0])
    assert abs(evidence.value - truth) < 5 * evidence.standard_error  # Student's t of 15: 1.6e-4
    assert abs(evidence.diagnostics["means"] - 0.25) < 5 * evidence.diagnostics["standard_errors"] < 0.25


class Cube:
    """A uniform prior: not a density of ours."""

    d = uniforms = 2

    def sample(self, u: Any) -> Any:
        """The cube itself."""
        return u

    def logpdf(self, x: Any) -> Any:
        """1 inside."""
        return np.where(((x >= 0) & (x < 1)).all(axis=1), 0.0, -np.inf)


def test_a_bounded_prior_and_a_likelihood_that_is_often_zero() -> None:
    """The mean of exp(-20 (x + y)) where x > 1/2: a product of two integrals, most of the prior excluded."""
    exact = math.log((math.exp(-10) - math.exp(-20)) / 20 * (1 - math.exp(-20)) / 20)

    def log_likelihood(x: Any) -> Any:
        return np.where(x[:, 0] > 0.5, -20 * x.sum(axis=1), -np.inf)

    evidence = smc.temper(Cube(), log_likelihood, particles=1024, moves=15, replicates=16, seed=3)
    assert abs(evidence.value - exact) < 5 * evidence.standard_error < 0.5  # Student's t of 15: 1.6e-4
    mean = 0.5 + 1 / 20 - 0.5 * math.exp(-10) / (1 - math.exp(-10))
    deviation = evidence.diagnostics["means"][0] - mean
    assert abs(deviation) < 5 * evidence.diagnostics["standard_errors"][0]


def test_moves_leave_the_tempered_density_invariant() -> None:
    """Kolmogorov-Smirnov of 4,000 exact draws after 10 steps; p below 10⁻⁴ once in 10⁴ runs each."""
    from evenlight.smc.random_walk import TemperedStates, step

    def evaluate(x: Any) -> TemperedStates:
        return TemperedStates(x, WIDE.logpdf(x), Normal(np.zeros(4), 0.5).logpdf(x))

    generator = np.random.default_rng(4)
    spread = math.sqrt(1 / (1 + 0.5 / 0.5))  # precision 1 of the prior, and half of the likelihood's 2
    states = evaluate(spread * generator.normal(size=(4000, 4)))
    before = states.x
    for _ in range(10):
        states, accepted = step(states, evaluate, 0.5, 0.6 * np.eye(4), generator.random((4000, 5)))
    assert 0.2 < accepted < 0.8
    assert (np.abs(states.x - before) > 0.01).any(axis=1).mean() > 0.95
    for j in range(4):
        assert stats.kstest(states.x[:, j] / spread, "norm").pvalue > 1e-4
    assert stats.kstest(np.sum((states.x / spread) ** 2, axis=1), stats.chi2(4).cdf).pvalue > 1e-4


def test_bits_and_refusals() -> None:
    runs = [smc.temper(WIDE, NARROW.logpdf, particles=126, replicates=r, seed=s) for r, s in ((2, 1), (3, 1), (2, 2))]
    logs = [run.diagnostics["replicates"] for run in runs]
    assert (logs[0] == logs[1][:2]).all()
    assert not (logs[0] == logs[2]).any()
    assert runs[0].merge(runs[2]).replicates == 4
    with pytest.raises(TypeError, match="prior must have d, uniforms, sample and logpdf, which str has not"):
        smc.temper("normal", NARROW.logpdf)
    with pytest.raises(ValueError, match="log_likelihood is nan at"):
        smc.temper(WIDE, lambda x: np.full(len(x), np.nan))
    with pytest.raises(ValueError, match="log_likelihood must return shape"):
        smc.temper(WIDE, lambda x: x)
    with pytest.raises(ValueError, match="weights of all particles are zero"):
        smc.temper(WIDE, lambda x: np.full(len(x), -np.inf))
    with pytest.raises(ValueError, match="temperatures must ascend"):
        smc.temper(WIDE, NARROW.logpdf, temperatures=[0.5, 0.2, 1.0])
    with pytest.raises(ValueError, match="effective must be between 0 and 1"):
        smc.temper(WIDE, NARROW.logpdf, effective=1.0)
    with pytest.raises(ValueError, match="unknown resampling"):
        smc.temper(WIDE, NARROW.logpdf, resampling="best")
    with pytest.raises(ValueError, match="moves must be at least 1"):
        smc.temper(WIDE, NARROW.logpdf, moves=0)
