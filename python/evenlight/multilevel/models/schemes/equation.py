"""A stochastic differential equation as its user writes it, with shapes checked: what schemes step along."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Equation"]

Array = NDArray[np.float64]

_NUDGE = 1e-5  # for central differences along a diffusion vector: errors of 1e-10 from curvature and from rounding


@dataclass(frozen=True)
class Equation:
    """dX = a(t, X) dt + b(t, X) dW, for blocks of X, shape (d, n)."""

    drift: Callable[[float, Array], Any]
    """Shape (d, n), or what broadcasts to it."""
    diffusion: Callable[[float, Array], Any]
    """Shape (d, m, n); or (d, n) if each component has a noise of its own."""
    derivative: Callable[[float, Array], Any] | None = None
    """∂b_ij/∂x_k, shape (d, m, d, n)."""

    def a(self, t: float, x: Array) -> Array:
        """The drift, shape (d, n)."""
        drift = np.asarray(self.drift(t, x), np.float64)
        try:
            return np.broadcast_to(drift, x.shape)
        except ValueError:
            raise ValueError(f"drift must return shape {x.shape}, not {drift.shape}") from None

    def b(self, t: float, x: Array) -> Array:
        """The diffusion, shape (d, m, n)."""
        d, n = x.shape
        diffusion = np.asarray(self.diffusion(t, x), np.float64)
        if diffusion.ndim == 3 and diffusion.shape[0] == d and diffusion.shape[2] in (1, n):
            return np.broadcast_to(diffusion, (d, diffusion.shape[1], n))
        if diffusion.shape != x.shape:
            raise ValueError(f"diffusion must return shape ({d}, m, {n}) or {x.shape}, not {diffusion.shape}")
        if d == 1:
            return diffusion[np.newaxis]
        full = np.zeros((d, d, n))
        full[np.arange(d), np.arange(d)] = diffusion
        return full

    def along(self, t: float, x: Array, b: Array, k: int) -> Array:
        """The derivative of the diffusion along its own column k, shape (d, m, n)."""
        if self.derivative is not None:
            d, m, n = b.shape
            derivative = np.asarray(self.derivative(t, x), np.float64)
            if derivative.shape not in ((d, m, d, n), (d, m, d, 1)):
                raise ValueError(f"derivative must return shape ({d}, {m}, {d}, {n}), not {derivative.shape}")
            return np.asarray((derivative * b[np.newaxis, np.newaxis, :, k]).sum(axis=2))
        nudge = _NUDGE * b[:, k]
        return (self.b(t, x + nudge) - self.b(t, x - nudge)) / (2.0 * _NUDGE)
