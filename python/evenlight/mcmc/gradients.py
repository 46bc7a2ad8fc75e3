"""Gradients of log densities: the user's own, by JAX or PyTorch, or by finite differences on request."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from .kernel import Array, LogDensity

__all__ = ["GRADIENTS", "Gradient", "with_gradient"]

Gradient: TypeAlias = Callable[[Any], Any] | str
"""A function from positions (m, d) to gradients (m, d), or a name in `GRADIENTS`."""

Function: TypeAlias = Callable[[Array], Array]


def finite_differences(log_density: LogDensity) -> tuple[LogDensity, Function]:
    """Central differences: 2 d values for each gradient, about 10 correct digits."""

    def gradient(x: Array) -> Array:
        m, d = x.shape
        step = np.finfo(float).eps ** (1 / 3) * np.maximum(1.0, np.abs(x))
        shifts = step[:, :, None] * np.eye(d)
        ends = np.concatenate([x[:, None] + shifts, x[:, None] - shifts]).reshape(-1, d)
        values = np.asarray(log_density(ends), np.float64).reshape(2, m, d)
        return np.asarray((values[0] - values[1]) / (2 * step))

    return log_density, gradient


def jax(log_density: LogDensity) -> tuple[LogDensity, Function]:
    """Of a log density written in `jax.numpy`: both compiled, in double precision."""
    try:
        import jax as library
    except ImportError:
        raise ImportError("gradient='jax' needs JAX: pip install jax") from None

    def in_double(function: Callable[[Any], Any]) -> Function:
        compiled = library.jit(function)

        def call(x: Array) -> Array:
            with library.enable_x64(True):
                return np.asarray(compiled(x), np.float64)

        return call

    return in_double(log_density), in_double(library.grad(lambda x: log_density(x).sum()))


def torch(log_density: LogDensity) -> tuple[LogDensity, Function]:
    """Of a log density written in PyTorch: tensors of double precision in and out."""
    try:
        import torch as library
    except ImportError:
        raise ImportError("gradient='torch' needs PyTorch: pip install torch") from None

    def values(x: Array) -> Array:
        with library.no_grad():
            return np.asarray(log_density(library.tensor(x, dtype=library.float64)).numpy(), np.float64)

    def gradient(x: Array) -> Array:
        with library.enable_grad():
            leaf = library.tensor(x, dtype=library.float64, requires_grad=True)
            (found,) = library.autograd.grad(log_density(leaf).sum(), leaf)
        return np.asarray(found.numpy(), np.float64)

    return values, gradient


GRADIENTS: dict[str, Callable[[LogDensity], tuple[LogDensity, Function]]] = {
    "finite-differences": finite_differences,
    "jax": jax,
    "torch": torch,
}
"""Ways to get a gradient from a log density: both as functions of NumPy's arrays."""


def with_gradient(log_density: LogDensity, gradient: Gradient) -> tuple[LogDensity, Function]:
    """A log density and its gradient as functions of NumPy's arrays, the gradient's shape checked.

    Parameters
    ----------
    log_density : callable
        Of blocks of positions.
    gradient : callable or {"finite-differences", "jax", "torch"}
        The gradient itself, or how to get it.

    Returns
    -------
    tuple of callable
        From positions (m, d) to values (m,) and to gradients (m, d).

    Raises
    ------
    ImportError
        If the library that is asked for is not installed.
    TypeError, ValueError
        If `gradient` is neither a function nor a known name.
    """
    if isinstance(gradient, str):
        if gradient not in GRADIENTS:
            raise ValueError(f"unknown gradient {gradient!r}; known: {', '.join(GRADIENTS)}, or a function")
        values, found = GRADIENTS[gradient](log_density)
    elif callable(gradient):
        values, found = log_density, gradient
    else:
        raise TypeError(
            f"gradient must be a function or one of {', '.join(GRADIENTS)}, not {type(gradient).__name__}; "
            "'finite-differences' works with every log density"
        )

    def checked(x: Array) -> Array:
        slopes = np.asarray(found(x), np.float64)
        if slopes.shape != x.shape:
            raise ValueError(f"the gradient must return the shape {x.shape}, not {slopes.shape}")
        return slopes

    return values, checked
