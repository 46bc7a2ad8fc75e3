"""Domains: where integrands live besides the unit cube, for `integrate(..., domain=)`. One domain, one file."""

from .box import Box
from .domain import Domain
from .law import Law
from .product import Product
from .triangle import Triangle

__all__ = ["DOMAINS", "Box", "Domain", "Law", "Product", "Triangle"]

DOMAINS: dict[str, type[Domain]] = {domain.name: domain for domain in (Box, Law, Triangle, Product)}
"""The classes by their names."""
