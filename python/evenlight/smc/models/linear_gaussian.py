"""The linear Gaussian model, of any dimension: the one whose likelihood is known exactly, by `kalman`."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import linalg

from evenlight.smc.state_space import Array, StateSpaceModel, normals

__all__ = ["LinearGaussian", "NormalNoise"]


class NormalNoise:
    """Centered normal numbers with a covariance: drawn, and their density."""

    def __init__(self, name: str, covariance: Array) -> None:
        try:
            self.root: Array = np.asarray(np.linalg.cholesky(covariance), np.float64)
        except np.linalg.LinAlgError:
            raise ValueError(f"{name} must be a positive definite covariance") from None
        self._whiten = linalg.solve_triangular(self.root, np.eye(len(self.root)), lower=True).T
        self._constant = -0.5 * len(self.root) * np.log(2 * np.pi) - float(np.log(np.diag(self.root)).sum())

    def sample(self, u: Array) -> Array:
        """Of uniform numbers, shape (n, d)."""
        z = normals(u)
        return z * self.root[0, 0] if len(self.root) == 1 else z @ self.root.T

    def logpdf(self, x: Array) -> Array:
        """The logarithm of the density, shape (n,), at points of shape (n, d)."""
        white = x * self._whiten[0, 0] if len(self.root) == 1 else x @ self._whiten
        return np.asarray(self._constant - 0.5 * np.einsum("ij,ij->i", white, white))


class LinearGaussian(StateSpaceModel):
    """X_t = F X_{t-1} + N(0, Q) and Y_t = H X_t + N(0, R), with X_0 normal.

    Parameters
    ----------
    transition : array_like, shape (d, d), or float
        F.
    noise : array_like, shape (d, d), or float
        Q, positive definite.
    observation : array_like, shape (k, d), or float
        H.
    observation_noise : array_like, shape (k, k), or float
        R, positive definite.
    mean : array_like, shape (d,), optional
        Of X_0; zero by default.
    covariance : array_like, shape (d, d), or float, optional
        Of X_0; the stationary one by default.

    Raises
    ------
    ValueError
        If shapes do not fit, a covariance is not positive definite, or none is stationary and none is given.

    Examples
    --------
    >>> from evenlight import smc
    >>> from evenlight.points import Sobol
    >>> model = smc.LinearGaussian([[0.9, 0.1], [0.0, 0.5]], [[1, 0], [0, 1]], [[1, 1]], 0.25)
    >>> y = [[0.3], [1.1], [-0.4]]
    >>> truth = smc.kalman(model, y).log_likelihood
    >>> evidence = smc.filter(model, y, particles=1024, points=Sobol, seed=1)
    >>> abs(evidence.value - truth) < 0.02
    True
    """

    name = "linear_gaussian"

    def __init__(
        self,
        transition: Any,
        noise: Any,
        observation: Any,
        observation_noise: Any,
        *,
        mean: Any = None,
        covariance: Any = None,
    ) -> None:
        self.transition = _matrix(transition)
        self.noise, self.observation = _matrix(noise), _matrix(observation)
        self.observation_noise = _matrix(observation_noise)
        d = self.dims = self.init_uniforms = self.move_uniforms = len(self.transition)
        k = self.outputs = len(self.observation)
        self.mean = np.zeros(d) if mean is None else np.atleast_1d(np.asarray(mean, np.float64))
        _check_shape("transition", self.transition, (d, d))
        _check_shape("noise", self.noise, (d, d))
        _check_shape("observation", self.observation, (k, d))
        _check_shape("observation_noise", self.observation_noise, (k, k))
        _check_shape("mean", self.mean, (d,))
        self.covariance = self._stationary() if covariance is None else _matrix(covariance)
        _check_shape("covariance", self.covariance, (d, d))
        self._init = NormalNoise("covariance", self.covariance)
        self._move = NormalNoise("noise", self.noise)
        self._observe = NormalNoise("observation_noise", self.observation_noise)

    def init(self, u: Array) -> Array:
        """First states, by the Cholesky factor of their covariance."""
        return self.mean + self._init.sample(u)

    def move(self, t: int, states: Array, u: Array) -> Array:
        """F times the states, and noise."""
        return self.predict(states) + self._move.sample(u)

    def log_observation(self, t: int, previous: Array | None, states: Array, y: Any) -> Array:
        """The normal density around H times the states."""
        seen = states * self.observation[0, 0] if self.observation.size == 1 else states @ self.observation.T
        return self._observe.logpdf(np.asarray(y, np.float64).reshape(self.outputs) - seen)

    def log_init(self, states: Array) -> Array:
        """The normal density of first states."""
        return self._init.logpdf(states - self.mean)

    def log_move(self, t: int, previous: Array, states: Array) -> Array:
        """The normal density of moves."""
        return self._move.logpdf(states - self.predict(previous))

    def predict(self, states: Array) -> Array:
        """F times the states."""
        return states * self.transition[0, 0] if self.dims == 1 else states @ self.transition.T

    def _stationary(self) -> Array:
        if np.abs(np.linalg.eigvals(self.transition)).max() >= 1:
            raise ValueError("covariance must be given: this transition has no stationary one")
        return np.asarray(linalg.solve_discrete_lyapunov(self.transition, self.noise))


def _matrix(numbers: Any) -> Array:
    return np.atleast_2d(np.asarray(numbers, np.float64))


def _check_shape(name: str, matrix: Array, shape: tuple[int, ...]) -> None:
    if matrix.shape != shape or not np.isfinite(matrix).all():
        raise ValueError(f"{name} must be finite numbers of shape {shape}, not of {matrix.shape}")
