"""Kernels: what all of them do. The uniform numbers of a step are an argument: random or evenly spread."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray
from scipy import special

__all__ = ["Array", "Info", "Kernel", "LogDensity", "State", "WarmUp", "metropolis", "normals"]

Array = NDArray[np.float64]

LogDensity = Callable[[Any], Any]
"""From positions, shape (m, d), to logarithms of the unnormalized target, shape (m,); minus infinity outside of it."""

LEAST = 2.0**-65  # instead of 0, whose normal quantile would be infinite


@dataclass(frozen=True, eq=False)
class State:
    """What the next step of each chain needs; kernels that need more extend it."""

    position: Array
    """Shape (chains, d)."""


@dataclass(frozen=True, eq=False)
class Info:
    """What a step has to tell besides, in arrays (chains, ...); kernels that have more to tell extend it."""

    acceptance: Array
    """The probability with which each chain's proposal was accepted."""
    accepted: NDArray[np.bool_]
    """Whether it was."""

    def columns(self) -> dict[str, Any]:
        """All fields by their names."""
        return {field.name: getattr(self, field.name) for field in fields(self)}


@dataclass(frozen=True, eq=False)
class WarmUp:
    """What is known while a kernel may still change: the chains so far, in windows of steps.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import RandomWalk, WarmUp
    >>> kernel = RandomWalk(lambda x: -0.5 * (x**2).sum(axis=1), scale=1.0)
    >>> kernel.adapted(WarmUp(np.zeros((4, 25, 2)), acceptance=0.9, window=1, windows=10)).scale > 1.5
    True
    """

    positions: Array
    """Of all steps so far, shape (chains, steps, d)."""
    acceptance: float
    """The mean probability of acceptance in the last window."""
    window: int
    """The number of the last window, from 1 on."""
    windows: int
    """How many windows there will be."""
    info: Mapping[str, Any] = field(default_factory=dict)
    """What the kernel told of all steps so far, by name: arrays (chains, steps, ...)."""

    @property
    def gain(self) -> float:
        """How much a window may still change: falls as window^(-0.6) (H. Robbins and S. Monro, 1951)."""
        return float(2.0 * self.window**-0.6)

    def covariance(self) -> Array:
        """Of the later half of the steps so far, over all chains, shape (d, d), shrunk a little to its diagonal.

        The diagonal is kept away from 0, for chains that have not moved.
        """
        half = self.positions[:, self.positions.shape[1] // 2 :]
        d = half.shape[2]
        rows = half.reshape(-1, d)
        if len(rows) < 2:
            return np.eye(d)
        covariance = np.atleast_2d(np.cov(rows, rowvar=False))
        weight = len(rows) / (len(rows) + 5.0 * d)
        diagonal = np.diag(np.maximum(np.diag(covariance), 1e-12))
        return np.asarray(weight * covariance + (1 - weight) * diagonal)


class Kernel:
    """A Markov kernel: plain settings, and one step of any number of chains as a function of uniform numbers.

    Laws: `step` leaves the target invariant if the uniform numbers are independent, treats every chain by itself
    (row i of what it returns depends on row i of its arguments alone), and is a pure function of its arguments.
    """

    name: ClassVar[str]
    """Its name in the registry."""
    random: ClassVar[bool] = True
    """Whether chains of the same start differ, so that their spread is an error."""

    def dims(self, d: int) -> int:
        """How many uniform numbers a step in d dimensions takes at most; it gets all of them, needed or not."""
        raise NotImplementedError

    def init(self, position: Any) -> Any:
        """Return the state of chains at positions, shape (chains, d).

        Raises
        ------
        ValueError
            If a position is no possible value of the target.
        """
        raise NotImplementedError

    def step(self, state: Any, uniforms: Array) -> tuple[Any, Info]:
        """One step of all chains, with uniform numbers in (0, 1) of shape (chains, dims(d))."""
        raise NotImplementedError

    def adapted(self, warm_up: WarmUp) -> Self:
        """Return the kernel with better settings after a window of the warm-up; most return themselves."""
        del warm_up
        return self


def metropolis(log_ratio: Array, uniforms: Array) -> tuple[NDArray[np.bool_], Array]:
    """Which proposals are accepted, and with which probability: the least of 1 and the ratio."""
    probability = np.exp(np.minimum(log_ratio, 0.0))
    return uniforms < probability, probability


def normals(uniforms: Array) -> Array:
    """Normal quantiles of uniform numbers in [0, 1)."""
    return np.asarray(special.ndtri(np.maximum(uniforms, LEAST)))
