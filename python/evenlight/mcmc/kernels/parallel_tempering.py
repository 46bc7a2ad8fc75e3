"""Parallel tempering: copies of the chain at higher temperatures, which swap positions. For targets with far modes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_callable
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, State, metropolis
from evenlight.mcmc.target import DensityState

__all__ = ["ParallelTempering", "TemperedState", "TemperingInfo"]


@dataclass(frozen=True, eq=False)
class TemperedState(State):
    """The position at inverse temperature 1, and the states at all temperatures."""

    levels: tuple[Any, ...]
    """States of the kernels, the coldest first."""
    even: bool
    """Whether pairs (0, 1), (2, 3), ... swap next, or pairs (1, 2), (3, 4), ..."""


@dataclass(frozen=True, eq=False)
class TemperingInfo(Info):
    """What a step has to tell; `acceptance` and `accepted` are those of the coldest kernel."""

    swaps: Array
    """Probabilities with which neighbors swapped, shape (chains, temperatures - 1); NaN where it was not their turn."""


@dataclass(frozen=True, eq=False)
class ParallelTempering(Kernel):
    """Kernels for the powers of the target, and swaps of neighbors, even and odd pairs in turn [2]_.

    A step costs a step of the kernel at each temperature; swaps cost nothing.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    inverse_temperatures : sequence of float
        From 1 down, above 0; the last one so small that its kernel crosses between modes. Neighbors should swap in
        about 40 % of their turns (`info["swaps"]`).
    within : callable
        ``within(log_density, beta)``: a kernel for a log density that is beta times yours already. Its state must be a
        `DensityState` or an extension by arrays that are proportional to the log density, such as its gradient.

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
    >>> kernel = ParallelTempering(modes, [1, 0.25, 0.06, 0.015], lambda f, beta: RandomWalk(f, scale=2 / beta**0.5))
    >>> chains = run(kernel, [10.0], n=1000, chains=16, burn_in=500, seed=1)
    >>> estimate = chains.estimate(lambda x: x[:, 0] > 0)
    >>> abs(estimate.value - 0.5) < 4 * estimate.standard_error < 0.2
    True
    """

    name: ClassVar[str] = "parallel_tempering"

    log_density: LogDensity
    inverse_temperatures: Sequence[float]
    within: Callable[[LogDensity, float], Any]
    _betas: Array = field(init=False, repr=False)
    _kernels: tuple[Kernel, ...] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        check_callable("within", self.within)
        betas = np.asarray(self.inverse_temperatures, np.float64)
        if betas.ndim != 1 or len(betas) < 2 or betas[0] != 1 or not ((np.diff(betas) < 0).all() and betas[-1] > 0):
            raise ValueError(
                f"inverse_temperatures must fall from 1, and stay above 0, not {self.inverse_temperatures}"
            )
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
        return TemperedState(levels[0].position, levels, True)

    def step(self, state: TemperedState, uniforms: Array) -> tuple[TemperedState, TemperingInfo]:
        """Move at each temperature, then swap even or odd pairs."""
        d = state.position.shape[1]
        levels, infos, used = [], [], 0
        for kernel, level in zip(self._kernels, state.levels, strict=True):
            dims = kernel.dims(d)
            after, info = kernel.step(level, uniforms[:, used : used + dims])
            levels.append(after)
            infos.append(info)
            used += dims
        swaps = np.full((len(uniforms), len(levels) - 1), np.nan)
        for cold in range(0 if state.even else 1, len(levels) - 1, 2):
            betas = self._betas[cold], self._betas[cold + 1]
            values = levels[cold].log_density / betas[0], levels[cold + 1].log_density / betas[1]
            swapped, swaps[:, cold] = metropolis(
                (betas[0] - betas[1]) * (values[1] - values[0]), uniforms[:, used + cold]
            )
            levels[cold : cold + 2] = _swap(levels[cold], levels[cold + 1], swapped, betas[1] / betas[0])
        cold_info = infos[0]
        after = TemperedState(levels[0].position, tuple(levels), not state.even)
        return after, TemperingInfo(cold_info.acceptance, cold_info.accepted, swaps)


def _tempered(log_density: LogDensity, beta: float) -> LogDensity:
    return lambda x: beta * log_density(x)


def _swap(cold: Any, warm: Any, rows: NDArray[np.bool_], ratio: float) -> tuple[Any, Any]:
    """Exchange rows; all but the positions is proportional to the inverse temperature."""
    colder, warmer = {}, {}
    for each in fields(cold):
        factor = 1.0 if each.name == "position" else ratio
        old_cold, old_warm = getattr(cold, each.name), getattr(warm, each.name)
        chosen = rows.reshape(-1, *[1] * (old_cold.ndim - 1))
        colder[each.name] = np.where(chosen, old_warm / factor, old_cold)
        warmer[each.name] = np.where(chosen, old_cold * factor, old_warm)
    return replace(cold, **colder), replace(warm, **warmer)
