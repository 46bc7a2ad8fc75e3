"""Test integrands with known integrals: the usual ones of the literature. One integrand, one file."""

from typing import Any

from .additive_exponential import AdditiveExponential
from .asian_option import AsianOption
from .ball import Ball
from .dyadic_rationals import DyadicRationals
from .genz_continuous import GenzContinuous
from .genz_corner_peak import GenzCornerPeak
from .genz_discontinuous import GenzDiscontinuous
from .genz_gaussian import GenzGaussian
from .genz_oscillatory import GenzOscillatory
from .genz_product_peak import GenzProductPeak
from .half_space import HalfSpace
from .jump import Jump
from .keister import Keister
from .kink import Kink
from .problem import Problem
from .product_linear import ProductLinear
from .singular_corner import SingularCorner
from .singular_point import SingularPoint

__all__ = [
    "INTEGRANDS",
    "AdditiveExponential",
    "AsianOption",
    "Ball",
    "DyadicRationals",
    "GenzContinuous",
    "GenzCornerPeak",
    "GenzDiscontinuous",
    "GenzGaussian",
    "GenzOscillatory",
    "GenzProductPeak",
    "HalfSpace",
    "Jump",
    "Keister",
    "Kink",
    "Problem",
    "ProductLinear",
    "SingularCorner",
    "SingularPoint",
    "build",
]

INTEGRANDS: dict[str, type[Problem]] = {
    problem.name: problem
    for problem in (
        GenzOscillatory,
        GenzProductPeak,
        GenzCornerPeak,
        GenzGaussian,
        GenzContinuous,
        GenzDiscontinuous,
        Keister,
        AsianOption,
        Ball,
        HalfSpace,
        SingularCorner,
        SingularPoint,
        AdditiveExponential,
        ProductLinear,
        Kink,
        Jump,
        DyadicRationals,
    )
}
"""The classes by their names in the registry."""


def build(name: str, d: int, **parameters: Any) -> Problem:
    """Build a test integrand.

    Parameters
    ----------
    name : str
        One of `INTEGRANDS`.
    d : int
        The number of coordinates.
    **parameters
        What the integrand asks besides: Genz's families take their `difficulty`.

    Returns
    -------
    Problem
        A function of blocks of points, with its integral as `exact`.

    Raises
    ------
    ValueError
        If the name is unknown, or `d` is not possible.

    Examples
    --------
    >>> import evenlight
    >>> from evenlight import integrands, points
    >>> f = integrands.build("keister", 5)
    >>> estimate = evenlight.integrate(f, points.Sobol(5, seed=1), n=2**14)
    >>> bool(abs(estimate.value - f.exact) < 4 * estimate.standard_error)
    True
    """
    if name not in INTEGRANDS:
        raise ValueError(f"unknown integrand {name!r}; known: {', '.join(INTEGRANDS)}")
    return INTEGRANDS[name](d, **parameters)
