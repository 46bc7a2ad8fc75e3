"""Euler-Maruyama: strong order 1/2, or 1 if the diffusion does not depend on the state. The cheapest step."""

from __future__ import annotations

from .equation import Array, Equation

__all__ = ["step"]


def step(equation: Equation, t: float, x: Array, dw: Array, h: float) -> Array:
    """X + a h + b ΔW.

    Reference: G. Maruyama, Rend. Circ. Mat. Palermo 4, 48-90 (1955).
    """
    y = x + equation.a(t, x) * h
    b = equation.b(t, x)
    for j in range(b.shape[1]):
        y += b[:, j] * dw[j]
    return y
