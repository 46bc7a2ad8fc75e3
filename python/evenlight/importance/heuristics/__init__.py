"""Heuristics of multiple importance sampling: how proposals share a point. One heuristic, one file."""

from collections.abc import Callable

from evenlight.importance.densities.density import Array

from . import balance, cutoff, maximum, power

__all__ = ["HEURISTICS", "weights"]

HEURISTICS: dict[str, Callable[[Array], Array]] = {
    "balance": balance.weights,
    "power": power.weights,
    "cutoff": cutoff.weights,
    "maximum": maximum.weights,
}
"""From expected densities n_j q_j(x), shape (n, J), to weights of the same shape that add up to 1 in every row."""


def weights(name: str, expected: Array) -> Array:
    """Weights by the name of a heuristic.

    Parameters
    ----------
    name : {"balance", "power", "cutoff", "maximum"}
        See E. Veach, *Robust Monte Carlo Methods for Light Transport Simulation* (1997), section 9.2.
    expected : ndarray of float64, shape (n, J)
        Number of points of each proposal times its density.

    Returns
    -------
    ndarray of float64, shape (n, J)
        Above 0 only where the density is; every row adds up to 1.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import weights
    >>> weights("power", np.array([[1.0, 3.0]]))
    array([[0.1, 0.9]])
    """
    if name not in HEURISTICS:
        raise ValueError(f"unknown heuristic {name!r}; known: {', '.join(HEURISTICS)}")
    return HEURISTICS[name](expected)
