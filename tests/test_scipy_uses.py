"""Wherever SciPy takes an engine of its own, it takes ours: integration, sensitivity, distributions, inversion."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from scipy import stats
from scipy.stats import qmc, sampling

from conftest import fitting_count, fitting_dims
from evenlight.points import SEQUENCES, Sobol

N = 1024


def kolmogorov(sample: Any, cdf: Any) -> float:
    """The distance to a distribution, in the unit in which independent samples exceed 2.7 once in a million times."""
    return float(stats.kstest(sample, cdf).statistic * np.sqrt(len(sample)))


@pytest.mark.parametrize("name", [name for name, sequence in SEQUENCES.items() if not sequence.finite])
@pytest.mark.filterwarnings("ignore:.*are balanced in powers of.*:UserWarning")
def test_inversion_by_polynomials(name: str) -> None:
    normal: Any = stats.norm()
    d = fitting_dims(name, 2)
    engine = SEQUENCES[name](d, seed=3, **fitting_count(name, d, N))
    drawn: Any = sampling.NumericalInversePolynomial(normal).qrvs(N, qmc_engine=engine)
    assert kolmogorov(drawn.reshape(N, -1)[:, 0], stats.norm.cdf) < 2.7


def test_fast_inversion() -> None:
    gamma = sampling.FastGeneratorInversion(stats.gamma(2.5)).qrvs(N, qmc_engine=Sobol(1, seed=3))
    # points that are spread evenly follow the distribution far better than independent ones
    assert kolmogorov(gamma, stats.gamma(2.5).cdf) < 0.1


def test_distributions_draw_from_it() -> None:
    drawn = stats.Normal(mu=1.0, sigma=2.0).sample(N, rng=Sobol(1, seed=3))
    assert kolmogorov(drawn, stats.norm(1, 2).cdf) < 0.1


def test_multinomial_and_normal_points() -> None:
    counts = qmc.MultinomialQMC([0.2, 0.3, 0.5], n_trials=N, engine=Sobol(1, seed=3)).random(1)[0]
    # one count for each point: those below 0.2, and so on, which nets hit to a point
    np.testing.assert_allclose(counts, [0.2 * N, 0.3 * N, 0.5 * N], atol=1)
    normal = qmc.MultivariateNormalQMC(np.zeros(4), engine=Sobol(4, seed=3)).random(N)
    np.testing.assert_allclose(np.cov(normal.T), np.eye(4), atol=0.02)


def ishigami(x: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """T. Ishigami and T. Homma (1990), on the unit cube."""
    a, b, c = np.pi * (2 * x - 1)
    value: npt.NDArray[np.float64] = np.sin(a) + 7 * np.sin(b) ** 2 + 0.1 * c**4 * np.sin(a)
    return value[np.newaxis]


def test_sensitivity_indices() -> None:
    """`sobol_indices` draws its own points unless it gets the values, so it gets values at ours."""
    both = Sobol(6, seed=3).random(2**13).T
    first, second = both[:3], both[3:]
    mixed = np.stack([np.where(np.arange(3)[:, np.newaxis] == j, second, first) for j in range(3)])
    values: Any = {"f_A": ishigami(first), "f_B": ishigami(second), "f_AB": np.stack([ishigami(x) for x in mixed])}
    found = stats.sobol_indices(func=values, n=2**13)
    # the known values of that function
    np.testing.assert_allclose(found.first_order, [0.3139, 0.4424, 0], atol=0.01)
    np.testing.assert_allclose(found.total_order, [0.5576, 0.4424, 0.2437], atol=0.01)
