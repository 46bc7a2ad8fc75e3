"""Mixed precision: one simulation in ever more exact arithmetic. Levels are number formats, not time steps."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.brownian import normals
from evenlight.multilevel.level_sampler import Coupled, LevelSampler

from .formats import Arithmetic, as_arithmetic
from .option import Option
from .row_blocks import row_blocks

__all__ = ["EulerCall", "MixedPrecision"]

Array = NDArray[np.float64]
Simulation = Callable[[Arithmetic, Array], Any]

_LADDER = ("fixed2", "fixed4", "fixed8", "float16", "float32", "float64")


@dataclass(frozen=True)
class EulerCall:
    """A European call by Euler's scheme, as `MixedPrecision` runs it.

    The state is the relative gain x = S / S_0 - 1, within -1 and 1 but for the rarest paths, so that few bits of a
    fixed point go far; a step is x + (g + x g), g = r h + σ ΔW.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import EulerCall, NativeFloat, Option
    >>> simulation = EulerCall(Option(rate=0.0, volatility=0.1))
    >>> simulation(NativeFloat(64), np.array([[1.0], [1.0], [1.0], [1.0]])).round(4)  # 1.05⁴
    array([21.5506])
    """

    option: Option = field(default_factory=Option)
    """Its terms."""

    def __call__(self, arithmetic: Arithmetic, z: Array) -> Array:
        """Discounted payoffs, shape (n,), from standard normal numbers, shape (steps, n)."""
        option, h = self.option, self.option.horizon / len(z)
        growth = arithmetic.number(z * (option.volatility * np.sqrt(h)) + option.rate * h)
        x = growth[0]
        for g in growth[1:]:
            x = arithmetic.add(x, arithmetic.add(g, arithmetic.multiply(x, g)))
        price = option.spot * (1.0 + arithmetic.double(x))
        return np.asarray(np.maximum(price - option.strike, 0.0) * option.discount)


class MixedPrecision(LevelSampler):
    """A simulation whose level l computes in format number l, and the coarse value in the format before.

    Random numbers are made once, in double precision; only what is computed from them is rounded. Otherwise the coarse
    simulation of one level would not have the mean of the fine one of the level below, and the sum would be biased.

    Parameters
    ----------
    formats : sequence of str or Arithmetic
        From few bits to many: "fixed2" and so on (fixed point, emulated), "bfloat16", "significand12" (floating point,
        emulated), "float16", "float32", "float64" (real). The last one defines the quantity.
    simulation : callable, optional
        From an `Arithmetic` and standard normal numbers, shape (steps, n), to values, shape (n,), in doubles. By
        default `EulerCall` with the default option.
    steps : int
        Normal numbers that a simulation takes.
    costs : sequence of float, optional
        Of a simulation in each format. By default that of a double-precision step is 1 and costs are proportional to
        bits; `measured_costs` has those of this machine.

    Raises
    ------
    ValueError
        If a format is unknown, there are none, or costs do not fit.

    Notes
    -----
    Two more bits of a significand reduce the variance of level differences by 16. Low formats pay where the hardware
    has them: here the emulated ones take more time than doubles, and half precision does too.

    Reference: C. Brugger, C. de Schryver, N. Wehn, S. Omland, M. Hefter, K. Ritter, A. Kostiuk and R. Korn, "Mixed
    precision multilevel Monte Carlo on hybrid computing systems", IEEE CIFEr 2014.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import MixedPrecision
    >>> model = MixedPrecision(["fixed8", "float16", "float32"])
    >>> u = np.random.default_rng(1).random((1000, model.dims(2)))
    >>> [bool(model.sample(2, u).difference.std() < 0.05), model.max_level, model.cost(2)]
    [True, 2, 6.0]
    """

    keyed = False
    exact = True

    def __init__(
        self,
        formats: Sequence[str | Arithmetic] = _LADDER,
        *,
        simulation: Simulation | None = None,
        steps: SupportsIndex = 8,
        costs: Sequence[float] | None = None,
    ) -> None:
        self.formats = [as_arithmetic(form) for form in formats]
        if not self.formats:
            raise ValueError("formats must have at least one")
        self.steps = integer("steps", steps, 1)
        stated = [self.steps * form.bits / 64.0 for form in self.formats] if costs is None else list(costs)
        if len(stated) != len(self.formats) or not all(0.0 < cost < np.inf for cost in stated):
            raise ValueError(f"costs must be {len(self.formats)} numbers above 0, one for each format, not {costs!r}")
        self._costs = stated
        self._simulation = EulerCall() if simulation is None else simulation
        self.name = f"mixed_precision {self.formats[0].name} to {self.formats[-1].name}"
        self.max_level = len(self.formats) - 1

    def dims(self, level: int) -> int:
        """The normal numbers, in order of time."""
        return self.steps

    def cost(self, level: int) -> float:
        """Both simulations."""
        return self._costs[level] + (self._costs[level - 1] if level else 0.0)

    def sample(self, level: int, u: Array) -> Coupled:
        """The quantity in the level's format and in the one before."""
        if not 0 <= level < len(self.formats):
            raise ValueError(f"level must be from 0 to {self.max_level}, one for each format, not {level}")
        numbers = self._checked(u)
        fine, coarse = np.empty(len(numbers)), np.zeros(len(numbers))
        for block in row_blocks(len(numbers), self.steps):
            z = np.ascontiguousarray(normals(numbers[block]).T)
            fine[block] = self._run(level, z)
            if level:
                coarse[block] = self._run(level - 1, z)
        return Coupled(fine, coarse, len(numbers) * self.cost(level))

    def ladder(self, level: int, u: Array) -> Array:
        """The quantity in all formats up to that of `level`, shape (n, level + 1)."""
        z = np.ascontiguousarray(normals(self._checked(u)).T)
        return np.stack([self._run(rung, z) for rung in range(level + 1)], axis=1)

    def measured_costs(self, n: int = 4096) -> list[float]:
        """Processor time of a simulation in each format, that of a step in double precision as 1.

        For `costs`. Emulated formats keep the stated cost of their bits: the time of an emulation says nothing.

        Parameters
        ----------
        n : int
            Simulations that are timed together, the best of five times.
        """
        z = np.random.default_rng(0).standard_normal((self.steps, n))
        whole = self._seconds(as_arithmetic("float64"), z) / self.steps
        return [
            self.steps * form.bits / 64.0 if form.emulated else self._seconds(form, z) / whole for form in self.formats
        ]

    def _seconds(self, form: Arithmetic, z: Array) -> float:
        times = []
        for _ in range(5):
            start = time.process_time_ns()
            self._simulation(form, z)
            times.append(time.process_time_ns() - start)
        return max(min(times), 1) * 1e-9

    def _run(self, level: int, z: Array) -> Array:
        values = np.asarray(self._simulation(self.formats[level], z))
        if values.shape != z.shape[1:] or values.dtype != np.float64:
            raise ValueError(
                f"simulation must return doubles of shape {z.shape[1:]}, not {values.dtype} {values.shape}"
            )
        return values

    def _checked(self, u: Any) -> Array:
        numbers = np.asarray(u, np.float64)
        if numbers.ndim != 2 or numbers.shape[1] != self.steps:
            raise ValueError(f"u must have shape (n, {self.steps}), not {numbers.shape}")
        return numbers
