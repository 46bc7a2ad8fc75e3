"""Waiting times at a single server with exponential services and arrivals (M/M/1): kinked, and many chains at zero."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import special

from .chain import Array, MarkovChain

__all__ = ["LindleyQueue"]


class LindleyQueue(MarkovChain):
    """W ← max(0, W + S - A) from an empty queue; the reward is the mean waiting time of all customers.

    Parameters
    ----------
    customers : int
        How many, after the first.
    load : float
        Arrivals per service, above 0.

    Raises
    ------
    ValueError
        If a parameter is not as above.

    Notes
    -----
    Exact by the identity of F. Spitzer, Trans. Am. Math. Soc. 82, 323-339 (1956): E W_j = Σ_{k≤j} E max(S_k, 0) / k,
    S_k a difference of two gamma variables.

    Examples
    --------
    >>> from evenlight import smc
    >>> round(smc.LindleyQueue(100).exact, 6)
    3.138196
    """

    name = "lindley_queue"
    dims, step_uniforms = 1, 2

    def __init__(self, customers: int = 100, load: float = 0.8) -> None:
        if customers < 1 or not 0 < load < np.inf:
            raise ValueError(f"customers must be at least 1 and load above 0, not {customers} and {load}")
        self.steps, self.load = customers, load
        k = np.arange(1, customers + 1)
        edge = 1 / (1 + load)  # services outlast arrivals where a beta variable exceeds it
        excess = special.betaincc(k + 1, k, edge) - special.betaincc(k, k + 1, edge) / load
        self.exact = float(np.cumsum(excess).mean())

    def init(self, n: int) -> Array:
        """An empty queue."""
        return np.zeros((n, 1))

    def step(self, t: int, states: Array, u: Array) -> Array:
        """A service and a gap between arrivals, by inversion."""
        change = np.log1p(-u[:, 1:]) / self.load - np.log1p(-u[:, :1])
        return np.maximum(states + change, 0.0)

    def reward(self, t: int, states: Array) -> Any:
        """Every customer's waiting time counts alike."""
        return states[:, 0] / self.steps
