"""Random coefficients of partial differential equations. One field, one file; `FIELDS` lists them."""

from __future__ import annotations

from typing import Any

from .field import Field
from .log_normal import LogNormalField
from .uniform import UniformField

__all__ = ["FIELDS", "Field", "LogNormalField", "UniformField", "as_field"]

FIELDS: dict[str, type[Any]] = {"log_normal": LogNormalField, "uniform": UniformField}
"""The classes by their names."""


def as_field(field: str | Field) -> Field:
    """A field, or the one of that name with its defaults."""
    if not isinstance(field, str):
        return field
    if field not in FIELDS:
        raise ValueError(f"unknown field {field!r}; known: {', '.join(FIELDS)}")
    built: Field = FIELDS[field]()
    return built
