"""What a multilevel run is to reach, and how its tolerance is split between bias and noise."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, SupportsIndex

import numpy as np

from evenlight.arguments import integer

__all__ = ["Goal"]

_DEEPEST = 20  # levels, where neither sampler nor caller say


@dataclass(frozen=True)
class Goal:
    """A tolerance and limits."""

    rmse: float
    max_level: Any
    """A number, or a pair of numbers."""
    max_cost: float
    exact: bool
    """Whether nothing is beyond `max_level`."""
    share: float
    """Of the squared tolerance, for bias and variance as estimated; the rest is for errors of these estimates."""

    @classmethod
    def of(
        cls,
        sampler: Any,
        rmse: float,
        max_level: SupportsIndex | None,
        max_cost: float,
        alpha: float | None,
        *,
        share: float,
    ) -> Goal:
        """Check the arguments of a run over levels."""
        finest = getattr(sampler, "max_level", None)
        if isinstance(finest, tuple):
            raise TypeError("sampler is refined in two directions, its levels are pairs; use multi_index")
        last = _DEEPEST if finest is None else finest
        if max_level is not None:
            last = min(integer("max_level", max_level, 0), math.inf if finest is None else finest)
        exact = bool(getattr(sampler, "exact", False)) and last == finest
        needed = 2 if alpha is None else 1
        if last < needed and not exact:
            raise ValueError(f"max_level = {last} is too coarse to know the bias; levels 0 to {needed} are needed")
        return cls.plain(sampler, rmse, int(last), max_cost, exact, share=share)

    @classmethod
    def plain(cls, sampler: Any, rmse: float, max_level: Any, max_cost: float, exact: bool, *, share: float) -> Goal:
        """Check what does not depend on how levels are numbered."""
        for name in ("dims", "sample", "cost"):
            if not callable(getattr(sampler, name, None)):
                raise TypeError(f"sampler must be a LevelSampler; {type(sampler).__name__} has no method {name!r}")
        if not 0.0 < rmse < math.inf:
            raise ValueError(f"rmse must be above 0, not {rmse}")
        if not max_cost > 0.0:
            raise ValueError(f"max_cost must be above 0, not {max_cost}")
        return cls(float(rmse), max_level, float(max_cost), exact, share)

    def fits(self, rmse: float, bias: Any) -> bool:
        """Whether the squared bias is at most half of what is to be spent of the squared tolerance."""
        return bool(np.all(np.asarray(bias) ** 2 <= 0.5 * self.share * rmse**2))

    def variance(self, rmse: float, bias: Any) -> Any:
        """What the variance of the estimate may be: what the bias leaves, at least half: the bias will yet shrink."""
        return np.maximum(self.share * rmse**2 - np.asarray(bias) ** 2, 0.5 * self.share * rmse**2)

    @property
    def too_coarse(self) -> str:
        """What to say if the last level is not fine enough."""
        return f"the bias is beyond the tolerance on max_level = {self.max_level}"

    @property
    def too_expensive(self) -> str:
        """What to say if the money is gone."""
        return f"max_cost = {self.max_cost:g} reached before the tolerance"
