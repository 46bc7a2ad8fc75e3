"""A normal autoregressive chain: smooth, kinked and jumping functions of its last state, all with exact means."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy import special

from evenlight.smc.state_space import normals

from .chain import Array, MarkovChain

__all__ = ["AutoregressiveChain"]


class AutoregressiveChain(MarkovChain):
    """X_t = ρ X_{t-1} + √(1 - ρ²) N(0, 1) from X_0 = 0; rewards are X, max(X, 0) and 1{X > 1} at the end.

    Parameters
    ----------
    steps : int
        How many.
    persistence : float
        ρ, from 0 to below 1.

    Raises
    ------
    ValueError
        If a parameter is not as above.

    Examples
    --------
    >>> from evenlight import smc
    >>> smc.AutoregressiveChain(20).exact.round(4)
    array([0.    , 0.396 , 0.1569])
    """

    name = "autoregressive"
    dims = step_uniforms = 1

    def __init__(self, steps: int = 20, persistence: float = 0.9) -> None:
        if steps < 1 or not 0 <= persistence < 1:
            raise ValueError(f"steps must be at least 1 and persistence in [0, 1), not {steps} and {persistence}")
        self.steps, self.persistence = steps, persistence
        spread = math.sqrt(1 - persistence ** (2 * steps))
        self.exact: Array = np.array([0.0, spread / math.sqrt(2 * math.pi), special.ndtr(-1 / spread)])

    def init(self, n: int) -> Array:
        """All at 0."""
        return np.zeros((n, 1))

    def step(self, t: int, states: Array, u: Array) -> Array:
        """One normal number each."""
        return self.persistence * states + math.sqrt(1 - self.persistence**2) * normals(u)

    def reward(self, t: int, states: Array) -> Any:
        """Three functions of the last state."""
        x = states[:, 0]
        return np.stack([x, np.maximum(x, 0.0), x > 1], axis=1) if t == self.steps else None
