"""Terms of a model, given by name: what is no term or no number is refused by its name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import fields
from numbers import Real
from typing import Any, TypeVar

__all__ = ["terms_of"]

Terms = TypeVar("Terms")


def terms_of(kind: type[Terms], given: Mapping[str, Any]) -> Terms:
    """The dataclass of terms with those that are given, or a ValueError."""
    known = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    for name, value in given.items():
        if name not in known:
            raise ValueError(f"unknown term {name!r}; known: {', '.join(known)}")
        if not (isinstance(value, Real) and math.isfinite(value)):
            raise ValueError(f"{name} must be a finite number, not {value!r}")
    return kind(**given)
