"""Chains of reactions: Poisson numbers, streams, linear networks with known means, gene transcription."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import special, stats

from evenlight.multilevel.models import ReactionNetwork, ReactionPaths, Streams, poisson
from evenlight.multilevel.models.reactions.exact_simulation import coupled_exactly, exactly
from evenlight.multilevel.models.reactions.tau_leaping import leaps
from level_moments import moments


@pytest.mark.parametrize("mean", [0.0, 1e-3, 0.7, 3.99, 4.0, 4.5, 8.0, 15.0, 100.0, 1e4, 1e7])
def test_poisson_numbers_are_the_inverse_of_their_distribution(mean: float) -> None:
    """Down to tails of 1e-10, beyond which doubles near 1 are too coarse to compare with."""
    rng = np.random.default_rng(1)
    tails = 10.0 ** rng.uniform(-10, 0, 2000)
    u = np.concatenate([rng.random(20_000), tails, 1 - tails])
    k = poisson(u, mean)
    blur = 1e-12 * max(mean, 1.0)  # relative, of SciPy's incomplete gamma functions
    assert (special.pdtr(k, mean) >= u * (1 - blur)).all()
    assert (special.pdtr(np.maximum(k - 1, 0), mean) <= u * (1 + blur))[k > 0].all()


def test_poisson_numbers_of_mixed_means() -> None:
    means = np.array([[0.0, 2.0, 300.0], [5.0, 1e5, 0.1]])
    u = np.array([[0.3, 0.6, 0.9], [0.01, 0.5, 0.999]])
    assert (poisson(u, means) == stats.poisson.ppf(u, means)).all()


def test_streams_are_functions_of_key_and_counter() -> None:
    """Uniform (chi-square of 64 cells), uncorrelated along a stream and between neighbors: 1 false alarm in 1,000."""
    keys = np.stack([np.arange(4096) / 4096, np.zeros(4096)], axis=1)
    streams = Streams(keys)
    numbers = streams.uniforms(0, 64)
    assert (numbers > 0).all() and (numbers < 1).all()
    assert (streams.uniforms(10, 2, np.array([5, 9])) == numbers[10:12, [5, 9]]).all()
    counts = np.histogram(numbers, bins=64, range=(0, 1))[0]
    assert stats.chisquare(counts).pvalue > 3e-4
    for one, other in ((numbers[1:], numbers[:-1]), (numbers[:, 1:], numbers[:, :-1])):
        assert abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]) < 3.6 / math.sqrt(one.size)


def conversion(x: NDArray[np.float64]) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
    """Molecules arrive, turn into another kind, and leave."""
    return 40.0, 2.0 * x[0], 0.5 * x[1]


LINEAR = ReactionNetwork([[1, 0], [-1, 1], [0, -1]], conversion, [10, 0], name="conversion")


def linear_mean() -> float:
    """Of the second kind at time 1: x' = A x + b with x(0) = (10, 0), solved by hand."""
    a = 20.0 + (10.0 - 20.0) * math.exp(-2.0)  # first kind: equilibrium 20, rate 2
    steady = 80.0
    # y' = 2 a(t) - y / 2 with a(t) = 20 - 10 exp(-2 t): y = 80 + c exp(-t / 2) + d exp(-2 t), d (-2 + 1/2) = -20
    d = -20.0 / (-2.0 + 0.5)
    assert a > 0
    return steady + (-steady - d) * math.exp(-0.5) + d * math.exp(-2.0)


def test_exact_paths_of_a_linear_network_have_its_law() -> None:
    """Both counts are sums of independent binomial and Poisson numbers; means within 4 sigma, 1 in 16,000 each."""
    n = 4000
    counts, events = exactly(LINEAR, Streams(np.random.default_rng(1).random((n, 2))), n, 1.0)
    first = 20.0 - 10.0 * math.exp(-2.0)
    variance = 10 * math.exp(-2.0) * (1 - math.exp(-2.0)) + 20.0 * (1 - math.exp(-2.0))
    assert abs(counts[0].mean() - first) <= 4 * math.sqrt(variance / n)
    assert counts[0].var() == pytest.approx(variance, rel=4 * math.sqrt(2 / n))
    assert abs(counts[1].mean() - linear_mean()) <= 4 * stats.sem(counts[1])
    assert (events >= counts.sum(axis=0) - 10).all()


def test_the_partner_of_an_exact_path_has_the_law_of_leaping() -> None:
    """And the exact one that of exact paths: two-sample tests of both kinds, 4 p-values above 1e-4."""
    n, steps = 3000, 4
    rng = np.random.default_rng(2)
    exact, partner, _ = coupled_exactly(LINEAR, Streams(rng.random((n, 2))), n, steps, 1.0)
    alone, _ = exactly(LINEAR, Streams(rng.random((n, 2))), n, 1.0)
    leaping = leaps(LINEAR, Streams(rng.random((n, 2))), n, steps, 1.0)
    for kind in (0, 1):
        assert stats.ks_2samp(exact[kind], alone[kind]).pvalue > 1e-4
        assert stats.ks_2samp(partner[kind], leaping[kind]).pvalue > 1e-4
    assert np.corrcoef(exact[1], partner[1])[0, 1] > 0.9


def test_sums_up_to_the_exact_chain_have_no_bias() -> None:
    model = ReactionPaths(LINEAR, exact_level=2, first_steps=2)
    n = 4000
    means, variances = moments(model, 3, n, seed=1)
    assert abs(means.sum() - linear_mean()) <= 4 * math.sqrt(variances.sum() / n)  # 1 in 16,000
    assert abs(means[1]) > 10 * math.sqrt(variances[1] / n)  # there is a bias to remove


def test_gene_transcription() -> None:
    """Published: level means 3122.3, 443, 111.5, 28.1, variances 1.01e6, 2.45e4, 2.45e3, 4.3e2; 4 sigma each."""
    model = ReactionPaths()
    rng = np.random.default_rng(3)
    means, errors = [], []
    for level, n in enumerate((6000, 20_000, 6000, 1000)):
        difference = model.sample(level, rng.random((n, 2))).difference
        means.append(float(difference.mean()))
        errors.append(float(stats.sem(difference)))
    published = [3122.3, 443.0, 111.5, 28.1]
    assert all(abs(m - p) <= 4 * e + 0.15 * (p < 4000) for m, p, e in zip(means, published, errors, strict=True))
    assert abs(means[1] - 443.0) <= 5.0
    ratio = means[1] / means[2]
    assert ratio == pytest.approx(4.0, abs=4 * ratio * math.hypot(errors[1] / means[1], errors[2] / means[2]))
    # what is left beyond the last level is a third of it, since differences fall by 4
    assert abs(sum(means) + means[3] / 3 - 3714.13) <= 4 * math.hypot(*errors, 0.24) + 1.0


def test_gene_transcription_without_bias() -> None:
    """The exact chain coupled with leaping on 8 steps, and leaping there: 4 sigma, most of them leaping's."""
    model = ReactionPaths(exact_level=1)
    rng = np.random.default_rng(4)
    exact = model.sample(1, rng.random((60, 2)))
    leaping = model.sample(0, rng.random((40_000, 2))).fine
    error = math.hypot(float(stats.sem(exact.difference)), float(stats.sem(leaping)))
    assert abs(exact.difference.mean() + leaping.mean() - 3714.13) <= 4 * error
    assert exact.difference.std() < exact.fine.std() / 3
