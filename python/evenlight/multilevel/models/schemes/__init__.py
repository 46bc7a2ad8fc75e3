"""Schemes: one time step of a stochastic differential equation. One scheme, one file; `SCHEMES` lists them."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from . import euler, milstein
from .equation import Array, Equation

__all__ = ["SCHEMES", "Equation", "Scheme"]


class Scheme(NamedTuple):
    """A step, and whether levels are coupled antithetically."""

    step: Callable[[Equation, float, Array, Array, float], Array]
    antithetic: bool


SCHEMES: dict[str, Scheme] = {
    "euler": Scheme(euler.step, antithetic=False),
    "milstein": Scheme(milstein.step, antithetic=False),
    "antithetic_milstein": Scheme(milstein.step, antithetic=True),
}
"""By their names."""
