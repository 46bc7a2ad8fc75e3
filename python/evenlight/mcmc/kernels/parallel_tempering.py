"""Parallel tempering: copies of the chain at higher temperatures, which swap positions. For targets with far modes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, State, WarmUp, metropolis
from evenlight.mcmc.ladder import rejections, respaced
from evenlight.mcmc.target import DensityState

__all__ = ["ParallelTempering", "TemperedState", "TemperingInfo"]

_RISING, _FALLING = 1, 2  # has been at the coldest level, and since then at the hottest


@dataclass(frozen=True, eq=False)
class TemperedState(State):
    """The position at inverse temperature 1, and the states at all temperatures."""

    levels: tuple[Any, ...]
    """States of the kernels, the coldest first, for the target itself: no temperature is in them."""
    even: bool
    """Whether pairs (0, 1), (2, 3), ... swap next, or pairs (1, 2), (3, 4), ..."""
    travels: NDArray[np.int8]
    """What is known of the way of each position, shape (chains, temperatures): 0, `_RISING` or `_FALLING`."""


@dataclass(frozen=True, eq=False)
class TemperingInfo(Info):
    """What a step has to tell; `acceptance` and `accepted` are those of the coldest kernel."""

    swaps: Array
    """Probabilities with which neighbors swapped, shape (chains, temperatures - 1); NaN where it was not their turn."""
    round_trips: NDArray[np.bool_]
    """Whether a position came back to the coldest level that had left it and been at the hottest."""


@dataclass(frozen=True, eq=False)
class ParallelTempering(Kernel):
    """Kernels for the powers of the target, and swaps of neighbors, even and odd pairs in turn [2]_.

    A step costs a step of the kernel at each temperature; swaps cost nothing. With `levels`, a warm-up spaces the
    temperatures so that all neighbors reject the same part of their swaps; `tempering_ladder` says how the ladder did,
    and how many levels there should be.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    within : callable
        ``within(log_density, beta)``: a kernel for a log density that is beta times yours already. Its state must be a
        `DensityState` or an extension by arrays that are proportional to the log density, such as its gradient.
    inverse_temperatures : sequence of float, optional
        From 1 down, above 0; the last one so small that its kernel crosses between modes. Without `levels`, they stay.
        By default a geometric sequence from 1 to `hottest`.
    levels : int, optional
        How many temperatures a warm-up is to space, all but the first and the last; 8 if no temperatures are given.
    hottest : float
        The last inverse temperature, where none are given.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] C. J. Geyer, "Markov chain Monte Carlo maximum likelihood", Computing Science and Statistics 23, 156-163
       (1991).
    .. [2] S. Syed, A. Bouchard-Côté, G. Deligiannidis and A. Doucet, "Non-reversible parallel tempering", J. R. Stat.
       Soc. B 84(2), 321-350 (2022).

    Examples
    --------
    Two modes 20 standard deviations apart:

    >>> import numpy as np
    >>> from evenlight.mcmc import ParallelTempering, RandomWalk, run
    >>> modes = lambda x: np.logaddexp(-0.5 * (x[:, 0] - 10) ** 2, -0.5 * (x[:, 0] + 10) ** 2)
    >>> kernel = ParallelTempering(modes, lambda f, beta: RandomWalk(f, scale=2 / beta**0.5), levels=4)
    >>> chains = run(kernel, [10.0], n=1000, chains=16, warm_up=500, seed=1)
    >>> estimate = chains.estimate(lambda x: x[:, 0] > 0)
    >>> abs(estimate.value - 0.5) < 4 * estimate.standard_error < 0.2
    True
    """

    name: ClassVar[str] = "parallel_tempering"

    log_density: LogDensity
    within: Callable[[LogDensity, float], Any]
    inverse_temperatures: Sequence[float] | None = None
    levels: int | None = None
    hottest: float = 0.01
    _betas: Array = field(init=False, repr=False)
    _kernels: tuple[Kernel, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        check_callable("within", self.within)
        if self.inverse_temperatures is None:
            if not 0 < self.hottest < 1:
                raise ValueError(f"hottest must be above 0 and below 1, not {self.hottest}")
            count = integer("levels", 8 if self.levels is None else self.levels, 2)
            object.__setattr__(self, "levels", count)
            object.__setattr__(self, "inverse_temperatures", tuple(np.geomspace(1, self.hottest, count).tolist()))
        betas = np.asarray(self.inverse_temperatures, np.float64)
        if betas.ndim != 1 or len(betas) < 2 or betas[0] != 1 or not ((np.diff(betas) < 0).all() and betas[-1] > 0):
            raise ValueError(
                f"inverse_temperatures must fall from 1, and stay above 0, not {self.inverse_temperatures}"
            )
        if self.levels not in (None, len(betas)):
            raise ValueError(f"there are {len(betas)} inverse_temperatures for {self.levels} levels")
        object.__setattr__(self, "_betas", betas)
        kernels = tuple(self.within(_tempered(self.log_density, beta), beta) for beta in betas.tolist())
        object.__setattr__(self, "_kernels", kernels)

    def dims(self, d: int) -> int:
        """Those of all kernels, and one for each pair of neighbors."""
        return sum(kernel.dims(d) for kernel in self._kernels) + len(self._betas) - 1

    def init(self, position: Any) -> TemperedState:
        """Return states at all temperatures, with the same positions."""
        levels = tuple(kernel.init(position) for kernel in self._kernels)
        if not all(isinstance(level, DensityState) for level in levels):
            raise TypeError("within must make kernels whose state has the log density, such as RandomWalk or HMC")
        levels = tuple(_scaled(level, 1 / beta) for level, beta in zip(levels, self._betas, strict=True))
        travels = np.zeros((len(levels[0].position), len(levels)), np.int8)
        travels[:, 0] = _RISING
        return TemperedState(levels[0].position, levels, True, travels)

    def step(self, state: TemperedState, uniforms: Array) -> tuple[TemperedState, TemperingInfo]:
        """Move at each temperature, then swap even or odd pairs."""
        d = state.position.shape[1]
        levels, infos, used = [], [], 0
        for kernel, level, beta in zip(self._kernels, state.levels, self._betas.tolist(), strict=True):
            dims = kernel.dims(d)
            after, info = kernel.step(_scaled(level, beta), uniforms[:, used : used + dims])
            levels.append(_scaled(after, 1 / beta))
            infos.append(info)
            used += dims
        swaps = np.full((len(uniforms), len(levels) - 1), np.nan)
        travels = state.travels.copy()
        for cold in range(0 if state.even else 1, len(levels) - 1, 2):
            gain = levels[cold + 1].log_density - levels[cold].log_density
            difference = self._betas[cold] - self._betas[cold + 1]
            swapped, swaps[:, cold] = metropolis(difference * gain, uniforms[:, used + cold])
            levels[cold : cold + 2] = _swap(levels[cold], levels[cold + 1], swapped)
            travels[swapped, cold : cold + 2] = travels[swapped, cold : cold + 2][:, ::-1]
        back = travels[:, 0] == _FALLING
        travels[:, 0] = _RISING
        travels[travels[:, -1] == _RISING, -1] = _FALLING
        after = TemperedState(levels[0].position, tuple(levels), not state.even, travels)
        return after, TemperingInfo(infos[0].acceptance, infos[0].accepted, swaps, back)

    def adapted(self, warm_up: WarmUp) -> ParallelTempering:
        """Space the temperatures anew after windows 1, 2, 4, ..., by the later half of the steps: those since then."""
        if self.levels is None or warm_up.window & (warm_up.window - 1):
            return self
        swaps = warm_up.info["swaps"][:, warm_up.positions.shape[1] // 2 :]
        if swaps.shape[1] < 2:
            return self
        return replace(self, inverse_temperatures=tuple(respaced(self._betas, rejections(swaps)).tolist()))


def _tempered(log_density: LogDensity, beta: float) -> LogDensity:
    return lambda x: beta * log_density(x)


def _scaled(state: Any, factor: float) -> Any:
    """The state for a power of its target: all but the position is proportional to the log density."""
    return replace(state, **{name: factor * value for name, value in _but_position(state).items()})


def _swap(cold: Any, warm: Any, rows: NDArray[np.bool_]) -> tuple[Any, Any]:
    """Exchange rows."""
    colder, warmer = {}, {}
    for each in fields(cold):
        old_cold, old_warm = getattr(cold, each.name), getattr(warm, each.name)
        chosen = rows.reshape(-1, *[1] * (old_cold.ndim - 1))
        colder[each.name] = np.where(chosen, old_warm, old_cold)
        warmer[each.name] = np.where(chosen, old_cold, old_warm)
    return replace(cold, **colder), replace(warm, **warmer)


def _but_position(state: Any) -> dict[str, Any]:
    return {each.name: getattr(state, each.name) for each in fields(state) if each.name != "position"}
