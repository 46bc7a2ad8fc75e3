"""Coefficients affine in uniform numbers: bounded away from 0, smooth, terms that decay at a chosen rate."""

from __future__ import annotations

import numpy as np

from evenlight.arguments import integer

from .field import Array

__all__ = ["UniformField"]


class UniformField:
    """1 + s Σ_k k^(-q) (2 u_k - 1) Π sin(π k x_i), with s such that values lie within 1 ± amplitude.

    Parameters
    ----------
    terms : int
        Of the sum.
    amplitude : float
        Above 0, below 1.
    decay : float
        The rate q, above 0.

    Raises
    ------
    ValueError
        If a number is not as above.

    Notes
    -----
    Cost: `terms` operations per place. Reference: F. Y. Kuo, C. Schwab and I. H. Sloan, SIAM J. Numer. Anal. 50(6),
    3351-3374 (2012), who study such fields with evenly spread points.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import UniformField
    >>> UniformField(terms=1, amplitude=0.5).values(np.array([[0.75]]), np.array([0.5]))
    array([[1.25]])
    """

    def __init__(self, terms: int = 8, *, amplitude: float = 0.9, decay: float = 2.0) -> None:
        if not (0.0 < amplitude < 1.0 and decay > 0.0):
            raise ValueError(f"amplitude must be between 0 and 1 and decay above 0, not {amplitude} and {decay}")
        self.terms = integer("terms", terms, 1)
        weights = np.arange(1.0, self.terms + 1.0) ** -decay
        self._weights = amplitude * weights / weights.sum()

    def values(self, u: Array, *places: Array) -> Array:
        """See `Field`."""
        terms = u.shape[1]
        waves = np.pi * np.arange(1.0, terms + 1.0)[:, np.newaxis]
        modes = self._weights[:terms, np.newaxis] * np.prod([np.sin(waves * place) for place in places], axis=0)
        return np.asarray(1.0 + (2.0 * u - 1.0) @ modes)
