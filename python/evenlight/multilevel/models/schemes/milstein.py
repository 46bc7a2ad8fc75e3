"""Milstein's scheme without Lévy areas: strong order 1 for one noise or commuting ones.

If noises do not commute, take it antithetically: the order is 1/2, but pairs of paths are as close as with order 1.
"""

from __future__ import annotations

from .equation import Array, Equation

__all__ = ["step"]


def step(equation: Equation, t: float, x: Array, dw: Array, h: float) -> Array:
    """X + a h + b ΔW + Σ_jk (b_k·∇) b_j (ΔW_j ΔW_k - δ_jk h) / 2.

    Reference: P. E. Kloeden and E. Platen, *Numerical Solution of Stochastic Differential Equations* (1992), section
    10.3, with the Lévy areas set to their mean, 0.
    """
    y = x + equation.a(t, x) * h
    b = equation.b(t, x)
    noises = b.shape[1]
    for k in range(noises):
        slope = equation.along(t, x, b, k)
        for j in range(noises):
            area = dw[j] * dw[k]
            if j == k:
                area -= h
            y += slope[:, j] * (0.5 * area)
        y += b[:, k] * dw[k]
    return y
