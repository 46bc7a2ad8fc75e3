"""Test integrands: their exact values against quadrature, published digits, and every kind of points."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate

import evenlight
from conftest import ROOT
from evenlight import integrands
from evenlight.points import Independent, Sobol

NAMES = list(integrands.INTEGRANDS)
DIMS = {"singular_point": 5}


@pytest.mark.parametrize("name", NAMES)
def test_integrals_agree_with_randomized_points(name: str) -> None:
    f = integrands.build(name, DIMS.get(name, 4))
    for points in (Sobol(f.d, seed=11), Independent(f.d, seed=11)):
        estimate = evenlight.integrate(f, points, n=2**16)
        # 36 comparisons: a false alarm in 500 runs of this test
        assert abs(estimate.value - f.exact) <= 5.5 * estimate.standard_error


@pytest.mark.parametrize("name", [name for name in NAMES if name not in ("singular_point", "dyadic_rationals")])
def test_integrals_agree_with_quadrature_in_one_dimension(name: str) -> None:
    f = integrands.build(name, 1)
    value, _ = integrate.quad(lambda x: float(f(np.array([[x]]))[0]), 0, 1, limit=500, epsabs=1e-11, epsrel=1e-11)
    assert value == pytest.approx(f.exact, rel=1e-7)


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize(
    "name", [name for name in NAMES if integrands.INTEGRANDS[name].kind == "smooth" and name != "keister"]
)
def test_smooth_integrals_agree_with_gauss(name: str, d: int) -> None:
    """Keister's has unbounded derivatives; its published digits are tested below."""
    f = integrands.build(name, d)
    nodes, weights = np.polynomial.legendre.leggauss(48)
    grid = np.stack(np.meshgrid(*[(nodes + 1) / 2] * d, indexing="ij"), axis=-1).reshape(-1, d)
    product = np.prod(np.stack(np.meshgrid(*[weights / 2] * d, indexing="ij"), axis=-1).reshape(-1, d), axis=1)
    assert f(grid) @ product == pytest.approx(f.exact, rel=1e-12)


@pytest.mark.parametrize(
    ("name", "d", "digits"),
    [
        ("keister", 1, 1.380388447043143),
        ("keister", 2, 1.808186429263620),
        ("keister", 3, 2.168309102165481),
        ("singular_point", 5, 0.173866966666),
        ("ball", 3, np.pi / 6),
        ("half_space", 2, 0.405),
    ],
)
def test_published_digits(name: str, d: int, digits: float) -> None:
    assert integrands.build(name, d).exact == pytest.approx(digits, rel=4e-12)


def test_fixed_points_fail_where_the_function_is_nowhere_continuous() -> None:
    f = integrands.build("dyadic_rationals", 2)
    assert evenlight.integrate(f, Sobol(2, scramble="none"), n=2**12).value == 1.0
    assert evenlight.integrate(f, Sobol(2, seed=1), n=2**12).value == f.exact == 0.0


def test_names_and_dimensions_are_checked() -> None:
    with pytest.raises(ValueError, match="unknown integrand 'x'; known: genz_oscillatory"):
        integrands.build("x", 2)
    with pytest.raises(ValueError, match="at least 1 dim"):
        integrands.build("ball", 0)
    with pytest.raises(ValueError, match="5 dimensions, not 6"):
        integrands.build("singular_point", 6)


def test_every_integrand_has_its_file() -> None:
    files = {path.stem for path in (ROOT / "python/evenlight/integrands").glob("*.py")}
    assert files == {*NAMES, "__init__", "geometric_asian", "problem"}
