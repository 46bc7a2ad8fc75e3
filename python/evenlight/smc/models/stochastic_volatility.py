"""Stochastic volatility: returns whose logarithmic variance is a slow hidden walk. The usual non-linear test model."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from evenlight.smc.state_space import Array, StateSpaceModel, normals

__all__ = ["StochasticVolatility"]


class StochasticVolatility(StateSpaceModel):
    """X_t = μ + ρ (X_{t-1} - μ) + σ N(0, 1) and Y_t = exp(X_t / 2) N(0, 1), with X_0 stationary.

    Parameters
    ----------
    mean : float
        μ.
    persistence : float
        ρ, between -1 and 1.
    volatility : float
        σ, above 0.

    Raises
    ------
    ValueError
        If a parameter is not as above.

    Notes
    -----
    Reference: S. Kim, N. Shephard and S. Chib, "Stochastic volatility: likelihood inference and comparison with ARCH
    models", Rev. Econ. Stud. 65(3), 361-393 (1998).

    Examples
    --------
    >>> from evenlight import smc
    >>> from evenlight.points import Sobol
    >>> evidence = smc.filter(smc.StochasticVolatility(), [0.5, -0.1, 0.9], particles=1024, points=Sobol, seed=1)
    >>> print(f"{evidence.value:.2f}")
    -2.95
    """

    name = "stochastic_volatility"
    dims = init_uniforms = move_uniforms = 1

    def __init__(self, mean: float = -1.0, persistence: float = 0.95, volatility: float = 0.2) -> None:
        if not (abs(persistence) < 1 and 0 < volatility < math.inf and math.isfinite(mean)):
            raise ValueError(
                f"mean must be finite, persistence between -1 and 1, volatility above 0; not {mean}, {persistence}, "
                f"{volatility}"
            )
        self.mean, self.persistence, self.volatility = mean, persistence, volatility
        self._spread = volatility / math.sqrt(1 - persistence**2)

    def init(self, u: Array) -> Array:
        """From the stationary normal distribution."""
        return self.mean + self._spread * normals(u)

    def move(self, t: int, states: Array, u: Array) -> Array:
        """Back towards the mean, with noise."""
        return self._predict(states) + self.volatility * normals(u)

    def log_observation(self, t: int, previous: Array | None, states: Array, y: Any) -> Array:
        """A centered normal density of variance exp(x)."""
        x = states[:, 0]
        logarithms = np.exp(-x)
        logarithms *= float(np.asarray(y).item()) ** 2
        logarithms += x
        logarithms += math.log(2 * math.pi)
        logarithms *= -0.5
        return logarithms

    def log_init(self, states: Array) -> Array:
        """The stationary normal density."""
        return _log_normal(states[:, 0] - self.mean, self._spread)

    def log_move(self, t: int, previous: Array, states: Array) -> Array:
        """The normal density of a move."""
        return _log_normal((states - self._predict(previous))[:, 0], self.volatility)

    def _predict(self, states: Array) -> Array:
        return self.mean + self.persistence * (states - self.mean)


def _log_normal(x: Array, spread: float) -> Array:
    return np.asarray(-0.5 * (x / spread) ** 2 - math.log(spread) - 0.5 * math.log(2 * math.pi))
