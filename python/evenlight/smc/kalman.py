"""The Kalman filter and smoother: exact answers for linear Gaussian models, by which particles are judged."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from evenlight.smc.models.linear_gaussian import LinearGaussian, NormalNoise
from evenlight.smc.state_space import Array

__all__ = ["Kalman", "kalman"]


class Kalman(NamedTuple):
    """What is known of a linear Gaussian model after T observations."""

    log_likelihood: float
    """The logarithm of the density of all observations."""
    filtering_means: Array
    """Of each state given the observations so far, shape (T, d)."""
    filtering_covariances: Array
    """Shape (T, d, d)."""
    smoothing_means: Array
    """Of each state given all observations, shape (T, d)."""
    smoothing_covariances: Array
    """Shape (T, d, d)."""


def kalman(model: LinearGaussian, observations: Any) -> Kalman:
    """Filter, smooth and evaluate the likelihood of a linear Gaussian model, exactly.

    Parameters
    ----------
    model : LinearGaussian
        The model.
    observations : array_like, shape (T, k), or (T,) if k = 1
        The observations.

    Returns
    -------
    Kalman
        Log-likelihood, means and covariances.

    Raises
    ------
    ValueError
        If the observations have another shape.

    Notes
    -----
    Cost O(T d³). References: R. E. Kalman, J. Basic Eng. 82(1), 35-45 (1960); H. E. Rauch, F. Tung and C. T. Striebel,
    AIAA J. 3(8), 1445-1450 (1965).

    Examples
    --------
    >>> from evenlight import smc
    >>> model = smc.LinearGaussian(0.5, 0.75, 1.0, 1.0)  # states and observations of variance 1 and 2
    >>> round(smc.kalman(model, [0.0]).log_likelihood, 6)  # minus half the logarithm of 2π times 2
    -1.265512
    """
    ys = np.asarray(observations, np.float64)
    if ys.size == 0 or ys.reshape(len(ys), -1).shape[1] != model.outputs:
        raise ValueError(f"observations must have shape (T, {model.outputs}) with T at least 1, not {ys.shape}")
    mean, covariance = model.mean, model.covariance
    total, means, covariances = 0.0, [], []
    for t, y in enumerate(ys.reshape(len(ys), -1)):
        if t > 0:
            mean = model.transition @ mean
            covariance = model.transition @ covariance @ model.transition.T + model.noise
        surprise = y - model.observation @ mean
        spread = model.observation @ covariance @ model.observation.T + model.observation_noise
        gain = np.linalg.solve(spread, model.observation @ covariance).T
        total += float(NormalNoise("the innovation's covariance", spread).logpdf(surprise[np.newaxis])[0])
        mean = mean + gain @ surprise
        covariance = covariance - gain @ spread @ gain.T
        means.append(mean)
        covariances.append(covariance)
    smoothed = _smooth(model, means, covariances)
    return Kalman(total, np.array(means), np.array(covariances), *smoothed)


def _smooth(model: LinearGaussian, means: list[Array], covariances: list[Array]) -> tuple[Array, Array]:
    """From the last state backwards (Rauch, Tung and Striebel 1965)."""
    smooth_means, smooth_covariances = [means[-1]], [covariances[-1]]
    for mean, covariance in zip(means[-2::-1], covariances[-2::-1], strict=True):
        predicted = model.transition @ covariance @ model.transition.T + model.noise
        gain = np.linalg.solve(predicted, model.transition @ covariance).T
        smooth_means.append(mean + gain @ (smooth_means[-1] - model.transition @ mean))
        smooth_covariances.append(covariance + gain @ (smooth_covariances[-1] - predicted) @ gain.T)
    return np.array(smooth_means[::-1]), np.array(smooth_covariances[::-1])
