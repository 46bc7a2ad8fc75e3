"""The indicator of a ball: a curved boundary, which no coordinate follows."""

from __future__ import annotations

import math

import numpy as np

from .problem import Array, Problem

__all__ = ["Ball"]


class Ball(Problem):
    """1 within the distance 1/2 of the center of the cube, else 0."""

    name = "ball"
    kind = "jump"
    cite = "volume: folklore"

    def __init__(self, d: int) -> None:
        super().__init__(d)
        self.exact = math.pi ** (d / 2) / math.gamma(d / 2 + 1) / 2.0**d

    def __call__(self, x: Array) -> Array:
        """Values at points of shape (n, d)."""
        return np.asarray((((x - 0.5) ** 2).sum(axis=1) <= 0.25).astype(np.float64))
