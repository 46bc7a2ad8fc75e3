"""Weights of particles from their logarithms: normalized, their mean, and what they are worth."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["effective_size", "log_mean_exp", "normalized"]

Array = NDArray[np.float64]


def normalized(log_weights: Array, when: str) -> tuple[Array, float]:
    """Weights of sum 1, and the logarithm of the mean of those given; `when` says where they come from."""
    largest = float(log_weights.max())
    if not math.isfinite(largest):
        lack = "the weights of all particles are zero" if largest == -math.inf else "a weight is no finite number"
        raise ValueError(f"{lack} at {when}; more particles or a proposal that knows the data may help")
    weights = log_weights - largest
    np.exp(weights, out=weights)
    total = float(weights.sum())
    weights /= total
    return weights, largest + math.log(total / len(weights))


def effective_size(weights: Array) -> float:
    """1 / Σ w² of weights of sum 1: how many equal weights they are worth."""
    return float(1.0 / np.dot(weights, weights))


def log_mean_exp(logarithms: Array) -> float:
    """The logarithm of the mean of numbers given by their logarithms."""
    largest = float(np.max(logarithms))
    return largest + math.log(float(np.mean(np.exp(logarithms - largest))))
