"""R^d under a probability density: the integral is an expectation."""

from __future__ import annotations

from typing import Any

from evenlight.importance.densities import as_density

from .domain import Array, Domain

__all__ = ["Law"]


class Law(Domain):
    """All of R^d, weighted with a density.

    Parameters
    ----------
    density : density
        Anything that `evenlight.importance.as_density` takes: ours, frozen distributions of SciPy, Python functions.

    Examples
    --------
    >>> import evenlight
    >>> from evenlight.domains import Law
    >>> from evenlight.importance import Normal
    >>> from evenlight.points import Sobol
    >>> estimate = evenlight.integrate(lambda x: x[:, 0] ** 2, Sobol(1), n=4096, domain=Law(Normal([0.0], 4.0)))
    >>> bool(abs(estimate.value - 4) < 0.02)
    True
    """

    name = "law"
    volume = 1.0

    def __init__(self, density: Any) -> None:
        self._density = as_density(density)
        self.d = self._density.uniforms

    def map(self, u: Array) -> Array:
        """Points that follow the density."""
        return self._density.sample(u)
