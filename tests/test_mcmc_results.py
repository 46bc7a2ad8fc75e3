"""What chains say: diagnostics against exact autocorrelations, ArviZ and figures, NUTS, gradients by libraries."""

from __future__ import annotations

import io
import re
import sys
from typing import Any

import arviz_base
import numpy as np
import pytest
from scipy import special

from evenlight import mcmc
from evenlight.mcmc import HMC, LFSR, NUTS, Antithetic, Gibbs, MetropolisHastings, Proposal, RandomWalk, RankRecord, run
from evenlight.mcmc.gradients import with_gradient


def normal(x: Any) -> Any:
    return -0.5 * (x**2).sum(axis=1)


def minus(x: Any) -> Any:
    return -x


# Proposals of an autoregression that leaves the normal target: always accepted, autocorrelation 0.8^lag.
REMEMBERING = MetropolisHastings(
    normal,
    Proposal(
        1,
        lambda x, u: 0.8 * x + 0.6 * special.ndtri(u),
        lambda y, x: -0.5 * (((y - 0.8 * x) / 0.6) ** 2).sum(axis=1),
    ),
)


def test_diagnostics_are_those_of_an_autoregression() -> None:
    """80,000 draws are worth a ninth: (1 - 0.8) / (1 + 0.8); the error of the mean has that of so many."""
    chains = run(REMEMBERING, [0.0], n=10_000, chains=8, burn_in=50, seed=2)
    found = chains.diagnostics()
    assert found.acceptance.min() > 1 - 1e-9
    np.testing.assert_allclose(found.autocorrelation[:4, 0], 0.8 ** np.arange(4), atol=0.02)
    assert found.ess_bulk[0] == pytest.approx(80_000 / 9, rel=0.1)
    assert found.mcse_mean[0] == pytest.approx((9 / 80_000) ** 0.5, rel=0.1)
    assert 0.999 < found.r_hat[0] < 1.01
    estimate = chains.estimate(lambda x: x[:, 0])
    assert abs(estimate.value) < 4 * found.mcse_mean[0]


def test_diagnostics_see_chains_that_disagree() -> None:
    stuck = run(RandomWalk(normal, scale=0.01), [[-2.0], [-1.0], [1.0], [2.0]], n=200)
    assert stuck.diagnostics().r_hat[0] > 1.5
    assert "R-hat is" in stuck.diagnostics().doubts[0]
    estimate = stuck.estimate(lambda x: x[:, 0])
    assert not estimate.converged
    assert "the chains disagree" in estimate.message
    sound = run(RandomWalk(normal), [0.0], n=4000, chains=8, burn_in=50)
    assert sound.diagnostics().doubts == ()
    assert (sound.estimate(lambda x: x[:, 0]).converged, sound.estimate(lambda x: x[:, 0]).message) == (True, "")


def test_diverging_trajectories_are_counted_and_told() -> None:
    """Steps of 3 deviations: leapfrog is unstable from 2 on."""
    chains = run(HMC(normal, minus, step_size=3.0, steps=6), [0.5], n=200, chains=8)
    count = int((chains.info["energy_error"] > 1000).sum())
    assert chains.divergences == count > 0
    assert f"{count} trajectories diverged" in chains.estimate(lambda x: x[:, 0]).message
    assert f"{count} trajectories diverged" in " ".join(chains.diagnostics().doubts)


def test_diagnostics_are_a_table_when_printed() -> None:
    lines = str(run(RandomWalk(normal), [[-2.0, 1.0], [2.0, 0.0]], n=100).diagnostics()).splitlines()
    assert lines[0].split() == ["mean", "sd", "mcse_mean", "ess_bulk", "ess_tail", "r_hat"]
    assert [line.split()[0] for line in lines[1:3]] == ["0", "1"]
    assert all("quantity" in line for line in lines[3:])


@pytest.mark.parametrize("points", [LFSR(10), Antithetic()])
def test_errors_of_driven_chains_do_not_come_from_their_steps(points: Any) -> None:
    kernel = Gibbs([lambda x, u: 0.5 * x[:, 1] + u, lambda x, u: 0.5 * x[:, 0] + u])
    chains = run(kernel, [1.0, 1.0], n=1024, chains=4, points=points)
    found = chains.diagnostics(lambda x: x[:, 0])
    assert np.isfinite(found.r_hat).all()
    for worth in (found.ess_bulk, found.ess_tail, found.mcse_mean, found.mcse_sd):
        assert worth.shape == (1,)
        assert np.isnan(worth).all()
    assert np.isfinite(chains.estimate(lambda x: x[:, 0]).standard_error)


def test_chains_convert_to_arviz() -> None:
    chains = run(HMC(normal, minus, step_size=0.3, steps=3), [0.0, 0.0], n=50, chains=3)
    tree = chains.to_arviz()
    assert (tree["posterior"]["x"].to_numpy() == chains.draws).all()
    assert set(tree["sample_stats"]) == {"acceptance_rate", "accepted", "energy_error", "n_steps", "diverging"}
    assert tree.attrs["kernel"] == "hmc"
    assert arviz_base.extract(tree, group="posterior").sizes["sample"] == 150
    mapped = chains.to_arviz({"radius": lambda x: np.hypot(x[:, 0], x[:, 1]), "both": np.exp})["posterior"]
    assert mapped["radius"].to_numpy() == pytest.approx(np.hypot(*np.moveaxis(chains.kept_draws(), 2, 0)))
    assert mapped["both"].shape == (3, 50, 2)
    assert repr(chains).startswith("Chains(3 of 50 steps in 2 dimensions, hmc driven by independent, seed=0, mean")


def test_records_become_figures() -> None:
    chains = run(RandomWalk(normal), [0.0, 0.0], n=400, chains=4, seed=1)
    ranks = mcmc.rank_record(chains, bins=8)
    np.testing.assert_allclose(ranks.counts.sum(axis=0), 4 * ranks.expected, rtol=0.05)  # but for ties
    assert (ranks.counts.sum(axis=1) == 400).all()
    for figure in (mcmc.trace_figure(mcmc.trace_record(chains)), mcmc.rank_figure(ranks)):
        out = io.BytesIO()
        figure.savefig(out, format="svg")
        assert len(out.getvalue()) > 5000
    squares = mcmc.trace_record(chains, most=100, functional=lambda x: x[:, 0] ** 2)
    np.testing.assert_array_equal(squares.values[:, :, 0], chains.kept_draws()[:, ::4, 0] ** 2)
    assert [panel.get_ylabel() for panel in mcmc.trace_figure(squares).axes] == ["f[0]"]
    legend = mcmc.rank_figure(ranks).axes[0].get_legend()
    assert [text.get_text() for text in legend.get_texts()] == ["chain 0", "chain 1", "chain 2", "chain 3"]
    assert (
        mcmc.rank_record(chains, bins=8, functional=lambda x: -x).counts[0, ::-1].tolist() == ranks.counts[0].tolist()
    )
    lean = run(RandomWalk(normal), [0.0], n=10, keep_draws=False)
    with pytest.raises(ValueError, match="kept no draws"):
        mcmc.trace_record(lean)


def test_nuts_agrees_with_a_correlated_normal() -> None:
    """10 dimensions, correlations 0.9^|i - j|: means and variances within 4 MCSE, 20 numbers: a false alarm in 800."""
    covariance = 0.9 ** np.abs(np.subtract.outer(np.arange(10), np.arange(10)))
    inverse = np.linalg.inv(covariance)
    sampler = NUTS(lambda x: -0.5 * ((x @ inverse) * x).sum(axis=1), lambda x: -x @ inverse)
    chains = sampler.run(np.zeros(10), n=600, chains=4, warm_up=300, seed=3)
    powers: list[tuple[Any, float]] = [(lambda x: x, 0.0), (np.square, 1.0)]
    for functional, exact in powers:
        found = chains.diagnostics(functional)
        means = functional(chains.kept_draws()).mean(axis=(0, 1))
        assert (np.abs(means - exact) < 4 * found.mcse_mean).all()
    assert chains.diagnostics().r_hat.max() < 1.03
    assert not chains.info["diverging"].any()


def test_nuts_is_deterministic_and_respects_edges() -> None:
    def half(x: Any) -> Any:
        return np.where(x[:, 0] > 0, -x[:, 0], -np.inf)

    sampler = NUTS(half, lambda x: -np.ones_like(x))
    one, same = (sampler.run([1.0], n=100, chains=2, warm_up=50, seed=4).draws for _ in range(2))
    assert one is not None and same is not None
    assert (one == same).all()
    assert one.min() > 0
    with pytest.raises(ValueError, match="density is 0"):
        sampler.run([-1.0], n=10)


@pytest.mark.parametrize(
    ("module", "call", "words"),
    [
        ("nutpie", lambda: NUTS(normal, minus).run([1.0], n=1), "pip install 'evenlight[nuts]'"),
        ("arviz_base", lambda: run(RandomWalk(normal), [0.0], n=5).to_arviz(), "pip install 'evenlight[arviz]'"),
        ("matplotlib.figure", lambda: mcmc.rank_figure(RankRecord(np.ones((1, 2, 1)), 1.0)), "'evenlight[plots]'"),
        ("jax", lambda: HMC(normal, "jax"), "pip install jax"),
        ("torch", lambda: HMC(normal, "torch"), "pip install torch"),
    ],
)
def test_missing_libraries_are_named(module: str, call: Any, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=re.escape(words)):
        call()


def imported(library: str) -> Any:
    """The library's module of functions. JAX comes with the tools; PyTorch, of 5 GB, by hand: pip install torch."""
    reason = "PyTorch is not among the tools, for its size; these tests passed with 2.15.0: pip install torch"
    return pytest.importorskip("jax.numpy" if library == "jax" else library, reason=reason)


@pytest.mark.parametrize("library", ["jax", "torch"])
def test_gradients_of_other_libraries_are_in_double_precision(library: str) -> None:
    module = imported(library)
    x = np.random.default_rng(1).normal(size=(20, 3))
    values, gradient = with_gradient(lambda x: -module.exp(x[:, 0]) * x[:, 1] - 0.5 * (x**2).sum(-1), library)
    np.testing.assert_allclose(values(x), -np.exp(x[:, 0]) * x[:, 1] - 0.5 * (x**2).sum(axis=1), rtol=1e-13)
    first = np.exp(x[:, 0])
    exact = np.stack([-first * x[:, 1], -first, np.zeros(20)], axis=1) - x
    np.testing.assert_allclose(gradient(x), exact, rtol=1e-12)


@pytest.mark.parametrize("library", ["jax", "torch"])
def test_chains_by_other_libraries_are_those_of_gradients_by_hand(library: str) -> None:
    """A quartic target, the same uniform numbers: the same draws but for rounding, by HMC; and NUTS runs."""
    imported(library)

    def quartic(x: Any) -> Any:
        return -0.25 * (x**4).sum(-1) - 0.5 * x[:, 0] * x[:, 1]

    def slopes(x: Any) -> Any:
        return -(x**3) - 0.5 * x[:, ::-1]

    settings: dict[str, Any] = {"step_size": 0.3, "steps": 5}
    theirs, ours = (run(HMC(quartic, g, **settings), [0.5, 0.1], n=30, seed=6).kept_draws() for g in (library, slopes))
    np.testing.assert_allclose(theirs, ours, rtol=1e-6, atol=1e-9)
    draws = NUTS(quartic, library).run([0.5, 0.1], n=20, chains=1, warm_up=20, seed=6).kept_draws()
    assert np.isfinite(draws).all() and draws.std() > 0.1
