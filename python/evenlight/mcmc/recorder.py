"""What a run keeps of its steps: positions, what the kernel tells, sums of functionals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .chains import Chains
from .kernel import Array, WarmUp

__all__ = ["Functionals", "Recorder"]

Functionals = Mapping[str, Callable[[Any], Any]]


class Recorder:
    """Keeps what is asked for, step by step."""

    def __init__(self, chains: int, n: int, functionals: Functionals, keep_draws: bool) -> None:
        self._shape = (chains, n)
        self._functionals = functionals
        self.sums: dict[str, Array] = {}
        self._keep = keep_draws
        self.draws: Array | None = None
        self.info: dict[str, Any] = {}

    def record(self, step: int, state: Any, info: Any) -> None:
        """Keep a step's state and info."""
        if self._keep:
            if self.draws is None:
                self.draws = np.empty((*self._shape, state.position.shape[1]))
            self.draws[:, step] = state.position
        for name, functional in self._functionals.items():
            values = np.asarray(functional(state.position), np.float64)
            if values.shape[:1] != self._shape[:1] or not np.isfinite(values).all():
                raise ValueError(
                    f"functionals[{name!r}] must return finite values ({self._shape[0]}, ...), not {values.shape}"
                )
            self.sums[name] = self.sums[name] + values if name in self.sums else values
        for name, column in info.columns().items():
            if name not in self.info:
                self.info[name] = np.empty((*self._shape, *column.shape[1:]), column.dtype)
            self.info[name][:, step] = column

    def warm_up(self, first: int, last: int, window: tuple[int, int]) -> WarmUp:
        """What is known after a window from step `first` to `last`, number so of so many."""
        assert self.draws is not None
        info = {name: column[:, :last] for name, column in self.info.items()}
        acceptance = float(info["acceptance"][:, first:].mean())
        return WarmUp(self.draws[:, :last], acceptance, *window, info)

    def take(self, earlier: Chains) -> None:
        """Begin with what an earlier, shorter run has kept."""
        if earlier.draws is not None:
            self.draws = np.empty((*self._shape, earlier.draws.shape[2]))
            self.draws[:, : earlier.n] = earlier.draws
        self.sums = dict(earlier.sums)
        for name, column in earlier.info.items():
            self.info[name] = np.empty((*self._shape, *column.shape[2:]), column.dtype)
            self.info[name][:, : earlier.n] = column
