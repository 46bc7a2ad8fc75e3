"""Number formats that simulations run in. One kind, one file; `FORMATS` lists them, `as_arithmetic` builds by name."""

from __future__ import annotations

import re
from typing import Any

from .arithmetic import Arithmetic, Array
from .fixed_point import FixedPoint
from .native_float import NativeFloat
from .rounded_float import RoundedFloat

__all__ = ["FORMATS", "Arithmetic", "Array", "FixedPoint", "NativeFloat", "RoundedFloat", "as_arithmetic"]

FORMATS: dict[str, type[Any]] = {"fixed": FixedPoint, "significand": RoundedFloat, "float": NativeFloat}
"""The classes by the word that a name starts with; a number of bits follows."""


def as_arithmetic(form: str | Arithmetic) -> Arithmetic:
    """A format, or the one of a name such as "fixed8", "bfloat16", "significand12" or "float32"."""
    if not isinstance(form, str):
        return form
    if form == "bfloat16":
        return RoundedFloat(8, bits=16, name=form)
    found = re.fullmatch(rf"({'|'.join(FORMATS)})(\d+)", form)
    if not found:
        raise ValueError(f"unknown format {form!r}; known: bfloat16, and {', '.join(FORMATS)} with a number of bits")
    built: Arithmetic = FORMATS[found[1]](int(found[2]))
    return built
