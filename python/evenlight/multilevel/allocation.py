"""How many samples each level takes, and how sure their sum is."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.intervals import degrees_of_sum
from evenlight.multilevel.level import Level, LevelRow

__all__ = ["LEAST", "degrees_of_freedom", "extend", "lacking"]

Array = NDArray[np.float64]

LEAST = 32
"""Samples of any level: fewer say nothing about a variance."""
_ENOUGH = 1.01  # more samples are worth a round if a level lacks more than this (Giles 2015, section 3.4)


def lacking(levels: Sequence[Level], variances: Array, variance: Any) -> Array:
    """Samples that each level lacks for a variance of the sum: N_l = √(V_l / C_l) Σ √(V_k C_k) / variance.

    `variances` are those of one sample, shape (levels, quantities); the quantity that needs most decides.
    """
    costs = np.array([[level.row.cost] for level in levels])
    n = np.sqrt(variances / costs) * np.sqrt(variances * costs).sum(axis=0) / variance
    wanted = np.maximum(np.ceil(n.max(axis=1)), LEAST)
    have = np.array([level.n for level in levels])
    more: Array = np.maximum(wanted - have, 0.0)
    return more if np.any(wanted > _ENOUGH * have) else np.zeros_like(more)


def extend(levels: Sequence[Level], more: Array, money: float) -> bool:
    """Draw more samples, or of all levels the share that the money allows; say whether all."""
    planned = sum(count * level.row.cost for count, level in zip(more, levels, strict=True))
    share = float(min(1.0, max(0.0, money) / planned))
    for count, level in zip(more, levels, strict=True):
        level.extend(level.n + int(share * count))
    return share == 1.0


def degrees_of_freedom(rows: Sequence[LevelRow]) -> float:
    """Degrees of freedom of the sum of the levels' means; of several quantities the least."""
    return degrees_of_sum([np.asarray(row.variance) / row.n for row in rows], [row.n - 1 for row in rows])
