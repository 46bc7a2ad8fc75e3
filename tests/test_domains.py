"""Domains: exact integrals over each, and refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy import stats

import evenlight
from conftest import ROOT
from evenlight import warp
from evenlight.domains import DOMAINS, Box, Law, Product, Triangle
from evenlight.importance import Normal, StudentT
from evenlight.points import Sobol

CORNERS = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]]  # area 7/2
PAIR = Product(Triangle(CORNERS), Triangle([[0, 0], [1, 0], [0, 1]]))


@pytest.mark.parametrize(
    ("domain", "f", "exact"),
    [
        (Box([-1, 2], [1, 5]), lambda x: x[:, 0] ** 2 * x[:, 1], 2 / 3 * 10.5),
        (Law(Normal([1.0, 0.0], [[2.0, 0.3], [0.3, 1.0]])), lambda x: x[:, 0] * x[:, 1], 0.3),
        (Law(stats.expon(scale=2)), lambda x: x[:, 0] ** 2, 8.0),
        (Law(StudentT([0.0], df=5)), lambda x: np.abs(x[:, 0]), float(stats.t(5).expect(np.abs))),
        (Triangle(CORNERS), lambda x: np.ones(len(x)), 3.5),
        (Triangle(CORNERS), lambda x: x[:, 2], 3.5),  # the mean of a coordinate is its mean over the corners
        (PAIR, lambda x: x[:, 1] * x[:, 3], 3.5 * 2 / 3 * 0.5 / 3),
    ],
)
def test_integrals_over_domains_are_exact(domain: Any, f: Any, exact: float) -> None:
    estimate = evenlight.integrate(f, Sobol(domain.d, seed=3), n=2**14, domain=domain)
    assert abs(estimate.value - exact) <= 5 * estimate.standard_error + 1e-12
    assert estimate.standard_error <= 1e-2 * abs(exact)


@pytest.mark.parametrize("name", ["TriangleHeitz", "TriangleMirror", "TriangleSort"])
def test_any_map_of_the_square_to_the_triangle_will_do(name: str) -> None:
    triangle = Triangle([[0, 0], [1, 0], [0, 1]], warp=getattr(warp, name)())
    estimate = evenlight.integrate(lambda x: x[:, 0] * x[:, 1], Sobol(2), n=2**12, domain=triangle)
    # five standard errors of 16 replicates: one in 6000
    assert abs(estimate.value - 1 / 24) < 5 * estimate.standard_error


def test_what_is_no_domain_is_refused() -> None:
    with pytest.raises(ValueError, match="low must be below high"):
        Box([0, 1], [1, 1])
    with pytest.raises(ValueError, match="lie on a line"):
        Triangle([[0, 0], [1, 1], [2, 2]])
    with pytest.raises(ValueError, match="from the square to a triangle"):
        Triangle([[0, 0], [1, 0], [0, 1]], warp=warp.DiskPolar())
    with pytest.raises(ValueError, match="at least one factor"):
        Product()
    with pytest.raises(TypeError, match=r"factor 1 must be a domain such as .*, not int"):
        Product(Box([0], [1]), 3)
    for domain, message in (Box, r"a domain, Box\(…\), not its class"), ([[0, 1]], "evenlight.domains.Box, not list"):
        with pytest.raises(TypeError, match=message):
            evenlight.integrate(lambda x: x[:, 0], Sobol(2), n=64, domain=domain)
    with pytest.raises(ValueError, match="takes points of 2 dimensions"):
        evenlight.integrate(lambda x: x[:, 0], Sobol(3), n=64, domain=Box([0, 0], [1, 1]))


def test_every_domain_has_its_file() -> None:
    files = {path.stem for path in (ROOT / "python/evenlight/domains").glob("*.py")}
    assert files == {*DOMAINS, "__init__", "domain"}
