"""A table of rates, measured: how fast errors fall for which points and which integrands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from evenlight import integrands
from evenlight.lab.rates import Rates, rates
from evenlight.points import Halton, Independent, Sobol

__all__ = ["RATE_CASES", "RateCase", "rates_table"]


@dataclass(frozen=True)
class RateCase:
    """One line of the table."""

    label: str
    """Points and integrand, in words."""
    theory: float
    """The power of n that is known."""
    f: Callable[[Any], Any]
    """The integrand."""
    points: Any
    """The points, fixed or with replicates."""
    settings: dict[str, Any] = field(default_factory=dict)
    """Of `rates`: numbers of points, replicates, the power of log n to take out."""


def _case(label: str, theory: float, integrand: str, points: Any, **settings: Any) -> RateCase:
    return RateCase(label, theory, integrands.build(integrand, points.d), points, settings)


RATE_CASES: tuple[RateCase, ...] = (
    _case("Monte Carlo, smooth", -0.5, "genz_gaussian", Independent(2), replicates=400),
    _case("Monte Carlo, discontinuous", -0.5, "ball", Independent(2), replicates=400),
    _case("Monte Carlo, singular", -0.5, "singular_corner", Independent(1), replicates=400),
    _case("QMC (Sobol'), finite variation, d = 4", -1.0, "additive_exponential", Sobol(4, scramble="none"), most=2**16),
    _case("QMC (van der Corput), finite variation", -1.0, "genz_gaussian", Halton(1, scramble="none"), most=2**16),
    _case("RQMC (Owen), smooth, d = 1", -1.5, "genz_product_peak", Sobol(1)),
    _case("RQMC (Owen), smooth, d = 2, log n taken out", -1.5, "genz_gaussian", Sobol(2), log_power=0.5, most=2**13),
    # a boundary meets n^((d - 1) / d) of n boxes, a point in each: Z. He, X. Wang, SIAM J. Num. Anal. 53, 2488 (2015)
    _case("RQMC (Owen), discontinuous, d = 2", -0.75, "ball", Sobol(2), replicates=200),
    _case("RQMC (Owen), discontinuous, d = 3", -2 / 3, "ball", Sobol(3), replicates=200),
    # the first of n strata has nearly all of the variance, n^(2A - 2)
    _case("RQMC (Owen), singular x^-0.4", -0.6, "singular_corner", Sobol(1), replicates=1000),
)
"""The lines of the table."""


def rates_table() -> list[tuple[RateCase, Rates]]:
    """Measure every line of the table: a few seconds.

    Returns
    -------
    list of (RateCase, Rates)
        What is known and what was measured.

    Examples
    --------
    >>> from evenlight.lab import RATE_CASES, rates
    >>> case = RATE_CASES[3]
    >>> abs(rates(case.f, case.points, **case.settings).slope - case.theory) < 0.1
    True
    """
    return [(case, rates(case.f, case.points, **case.settings)) for case in RATE_CASES]
