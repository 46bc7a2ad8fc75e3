"""Products of domains: one point of each, side by side."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenlight.arguments import check_domain

from .domain import Array, Domain

__all__ = ["Product"]


class Product(Domain):
    """Tuples of points, one of each factor; products of triangles, for instance, are where light paths live.

    Parameters
    ----------
    *factors : domain
        At least one.

    Raises
    ------
    TypeError, ValueError
        If one of them is no domain, or there is none.

    Examples
    --------
    >>> import evenlight
    >>> from evenlight.domains import Box, Product, Triangle
    >>> from evenlight.points import Sobol
    >>> pair = Product(Triangle([[0, 0], [1, 0], [0, 1]]), Box([0], [2]))
    >>> estimate = evenlight.integrate(lambda x: x[:, 0] * x[:, 2], Sobol(3), n=4096, domain=pair)
    >>> bool(abs(estimate.value - 1 / 3) < 1e-3)
    True
    """

    name = "product"

    def __init__(self, *factors: Any) -> None:
        if not factors:
            raise ValueError("a product needs at least one factor")
        for number, factor in enumerate(factors):
            check_domain(f"factor {number}", factor)
        self.factors = factors
        self.d = sum(int(factor.d) for factor in factors)
        self.volume = float(np.prod([factor.volume for factor in factors]))

    def map(self, u: Array) -> Array:
        """Points of the factors, their coordinates side by side."""
        ends = np.cumsum([factor.d for factor in self.factors])[:-1]
        return np.hstack(
            [factor.map(part) for factor, part in zip(self.factors, np.split(u, ends, axis=1), strict=True)]
        )
