"""Rates of convergence: the fit against made-up errors, and a table of them within 0.1 of theory."""

from __future__ import annotations

import numpy as np
import pytest

import evenlight
from evenlight import integrands, lab
from evenlight.points import Independent, InterlacedSobol, LatinHypercube, Sobol


@pytest.mark.parametrize("case", lab.RATE_CASES, ids=lambda case: case.label)
def test_the_table_of_rates(case: lab.RateCase) -> None:
    """Slopes have standard errors of 0.02 to 0.04: seeds are fixed, and the table holds as it stands."""
    measured = lab.rates(case.f, case.points, **case.settings)
    print(f"{case.label}: {measured.slope:.3f} ± {measured.slope_error:.3f} (theory {case.theory:.3f})")
    assert abs(measured.slope - case.theory) < 0.1
    assert np.isnan(measured.slope_error) or measured.slope_error < 0.05


def test_randomization_beats_independent_points_wherever_the_square_is_integrable() -> None:
    for name, d in (("singular_corner", 1), ("ball", 3), ("jump", 4), ("genz_discontinuous", 3)):
        f = integrands.build(name, d)
        plain = lab.rates(f, Independent(d), most=2**11, replicates=200).rmse[-1]
        spread = lab.rates(f, Sobol(d), most=2**11, replicates=200).rmse[-1]
        assert spread < 0.8 * plain, name


@pytest.mark.parametrize(("order", "slope"), [(2, -2.0), (3, -2.5)])
def test_interlaced_nets_are_faster_where_the_integrand_is_smooth(order: int, slope: float) -> None:
    """Theory, up to powers of log n: -2.5 and -3.5 in the end; nets of order 1 stay at -1.5."""
    f = integrands.build("additive_exponential", 1)
    measured = lab.rates(f, InterlacedSobol(1, order=order, seed=1), most=2**10, replicates=60)
    print(f"order {order}: {measured.slope:.3f} ± {measured.slope_error:.3f}")
    assert measured.slope + 2 * measured.slope_error < slope


def test_fixed_points_do_not_converge_where_randomized_ones_do() -> None:
    f = integrands.build("dyadic_rationals", 1)
    fixed = lab.rates(f, Sobol(1, scramble="none"))
    assert fixed.slope == pytest.approx(0.0, abs=1e-12)
    assert (fixed.rmse == 1).all()
    assert evenlight.integrate(f, Sobol(1, seed=1), n=2**12).value == f.exact


def test_the_jackknife_says_how_far_slopes_scatter() -> None:
    f = integrands.build("genz_gaussian", 1)
    measured = [lab.rates(f, Independent(1, seed=seed), most=2**9, replicates=100) for seed in range(40)]
    actual = np.std([m.slope for m in measured], ddof=1)
    stated = np.sqrt(np.mean([m.slope_error**2 for m in measured]))
    assert 0.65 < stated / actual < 1.6  # chi-square with 39 degrees of freedom, 1e-3 on either side


def test_designs_are_built_anew_for_every_number() -> None:
    """Latin hypercubes: n^(-3/2) for sums of functions of one variable, each smooth (M. Stein, 1987)."""
    measured = lab.rates(lambda x: np.exp(x).sum(axis=1), LatinHypercube(3, seed=1), exact=3 * (np.e - 1))
    assert abs(measured.slope + 1.5) < 0.1


def test_what_has_no_slope_is_refused() -> None:
    with pytest.raises(ValueError, match=r"one number for each point, not \(2,\)"):
        lab.rates(lambda x: x, Sobol(2), exact=0.5)
    with pytest.raises(ValueError, match=r"one number for each point, not \(2,\)"):
        lab.rates(lambda x: x, Sobol(2, scramble="none"), exact=0.5)
    with pytest.raises(ValueError, match="exact integral must be known"):
        lab.rates(lambda x: x[:, 0], Sobol(1))
    with pytest.raises(ValueError, match="there is no slope"):
        lab.rates(lambda x: np.ones(len(x)), Sobol(1), exact=1.0)
    with pytest.raises(ValueError, match="there must be a doubling"):
        lab.rates(lambda x: x[:, 0], Sobol(1), exact=0.5, least=8, most=8)
