"""Options on geometric Brownian motion: the standard problem of multilevel methods, with known prices."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.brownian import CONSTRUCTIONS, brownian_increments
from evenlight.multilevel.level_sampler import Coupled, LevelSampler
from evenlight.multilevel.work_arrays import work_array

from .option import Option
from .path import Path
from .payoffs import PAYOFFS
from .row_blocks import row_blocks
from .terms import terms_of

__all__ = ["GeometricBrownianMotion"]

Array = NDArray[np.float64]

_BLOCK = 2**15  # numbers that are worked on at once: what a second-level cache holds
_ROWS = 512  # but no fewer paths than this: a step of a block has its overhead


def _euler(increments: Array, step: float, option: Option, factors: Array) -> None:
    """1 + r h + σ ΔW."""
    np.multiply(increments, option.volatility, out=factors)
    factors += 1.0 + option.rate * step


def _milstein(increments: Array, step: float, option: Option, factors: Array) -> None:
    """1 + r h + σ ΔW + σ² (ΔW² - h) / 2, with the square completed."""
    np.multiply(increments, option.volatility, out=factors)
    factors += 1.0
    factors *= factors
    factors *= 0.5
    factors += 0.5 + (option.rate - option.volatility**2 / 2) * step


def _exact(increments: Array, step: float, option: Option, factors: Array) -> None:
    """exp((r - σ²/2) h + σ ΔW)."""
    np.multiply(increments, option.volatility, out=factors)
    factors += (option.rate - option.volatility**2 / 2) * step
    np.exp(factors, out=factors)


_SCHEMES: dict[str, Callable[[Array, float, Option, Array], None]] = {
    "euler": _euler,
    "milstein": _milstein,
    "exact": _exact,
}


class GeometricBrownianMotion(LevelSampler):
    """An option on dS = r S dt + σ S dW; level l has 2^l times the time steps of level 0.

    Parameters
    ----------
    payoff : {"european", "asian", "lookback", "barrier", "digital"}
        See `payoffs`.
    scheme : {"milstein", "euler", "exact"}
        "euler": strong order 1/2 and payoffs at grid points. "milstein": strong order 1, and payoffs with the Brownian
        bridge or the conditional expectation that it deserves. "exact": no error at grid points, otherwise as
        "milstein"; the best for Asian options (European ones then have no levels to speak of).
    construction : {"incremental", "bridge", "pca"}
        How uniform numbers become Brownian motion; one of the latter two with evenly spread points.
    first_steps : int
        Time steps on level 0.
    **terms
        Of the option and its asset; see `Option`.

    Raises
    ------
    ValueError
        If a name is unknown or a term impossible.

    Notes
    -----
    Cost: one unit per time step, of either path. Weak order 1 (Asian, exact: 2); variances fall per level as each
    payoff's file says. All exponents are measured in the tests.

    References: M. B. Giles, "Multilevel Monte Carlo path simulation", Oper. Res. 56(3), 607-617 (2008); "Improved
    multilevel Monte Carlo convergence using the Milstein scheme", in Monte Carlo and Quasi-Monte Carlo Methods 2006,
    343-358 (2008).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import GeometricBrownianMotion
    >>> model = GeometricBrownianMotion("barrier", barrier=90.0)
    >>> coupled = model.sample(3, np.random.default_rng(1).random((1000, model.dims(3))))
    >>> bool(coupled.difference.std() < coupled.fine.std() / 20), coupled.cost
    (True, 12000.0)
    >>> round(model.known_value, 6)
    8.665472
    """

    max_level = None
    keyed = False

    def __init__(
        self,
        payoff: str = "european",
        scheme: str = "milstein",
        *,
        construction: str = "incremental",
        first_steps: int = 1,
        **terms: float,
    ) -> None:
        for what, name, known in (
            ("payoff", payoff, PAYOFFS),
            ("scheme", scheme, _SCHEMES),
            ("construction", construction, CONSTRUCTIONS),
        ):
            if name not in known:
                raise ValueError(f"unknown {what} {name!r}; known: {', '.join(known)}")
        self.option = terms_of(Option, terms)
        self.payoff = PAYOFFS[payoff](self.option)
        self.scheme = scheme
        self.construction = construction
        self.first_steps = integer("first_steps", first_steps, 1)
        self.name = f"gbm {payoff} {scheme}"
        self._value = self.payoff.plain if scheme == "euler" else self.payoff.smooth
        self._takes_uniforms = scheme != "euler" and self.payoff.takes_uniforms

    @property
    def known_value(self) -> float | None:
        """The price in continuous time, or None where there is no formula."""
        return self.payoff.exact()

    def steps(self, level: int) -> int:
        """Time steps of the fine path."""
        return self.first_steps << integer("level", level, 0)

    def dims(self, level: int) -> int:
        """The numbers of the Brownian motion, then those of the payoff if it takes any."""
        return self.steps(level) * (2 if self._takes_uniforms else 1)

    def cost(self, level: int) -> float:
        """Time steps of both paths."""
        return float(self.steps(level) + (self.steps(level - 1) if level else 0))

    def sample(self, level: int, u: Array) -> Coupled:
        """Discounted payoffs of the fine path and of the coarse one."""
        rungs = self._rungs(level, u, max(level - 1, 0))
        coarse = rungs[0] if level else np.zeros(len(u))
        return Coupled(rungs[-1], coarse, len(u) * self.cost(level))

    def ladder(self, level: int, u: Array) -> Array:
        """Discounted payoffs of paths of all levels up to `level`, shape (n, level + 1)."""
        return self._rungs(level, u, 0).T

    def _rungs(self, level: int, u: Any, lowest: int) -> Array:
        """Values of levels lowest, …, level along the same motion, shape (levels, n)."""
        steps = self.steps(level)
        if np.ndim(u) != 2 or np.shape(u)[1] != self.dims(level):
            raise ValueError(f"u must have shape (n, {self.dims(level)}) on level {level}, not {np.shape(u)}")
        values = np.empty((level - lowest + 1, len(u)))
        for rows in row_blocks(len(u), steps, numbers=_BLOCK, least=_ROWS):
            self._block(np.asarray(u[rows], np.float64), values[:, rows])
        return values

    def _block(self, u: Array, values: Array) -> None:
        steps = u.shape[1] // (2 if self._takes_uniforms else 1)
        motion = brownian_increments(u[:, :steps], horizon=self.option.horizon, construction=self.construction)
        increments = work_array("increments", motion.T.shape)
        np.copyto(increments, motion.T)
        uniforms = np.ascontiguousarray(u[:, steps:].T) if self._takes_uniforms else None
        own, prices = increments, self._prices(increments)
        for rung in reversed(range(len(values))):
            step = self.option.horizon / (len(prices) - 1)
            values[rung] = self._value(Path(prices, increments, step, self.option.volatility, uniforms))
            if rung and self.scheme == "exact":  # the coarse path is at the same places, at every other time
                prices = prices[::2]
            elif rung:
                halves = own[0::2], own[1::2]
                own = np.add(*halves, out=work_array("coarse increments", halves[0].shape))
                prices = self._prices(own)

    def _prices(self, increments: Array) -> Array:
        prices = work_array("prices", (len(increments) + 1, increments.shape[1]))
        prices[0] = self.option.spot
        _SCHEMES[self.scheme](increments, self.option.horizon / len(increments), self.option, prices[1:])
        for before, after in pairwise(prices):
            after *= before
        return prices
