"""Running chains: warm-up, burn-in, and the steps that count, driven by random or by evenly spread numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, SupportsIndex

import numpy as np

from evenlight import _core
from evenlight.arguments import SeedLike, check_callable, integer, seed_number

from .chains import Chains
from .driving import Driving, IndependentNumbers
from .kernel import Array, Kernel, WarmUp

__all__ = ["run"]

_WINDOW = 25  # steps between changes of settings in a warm-up
_MOST_NUMBERS = 2**20  # uniform numbers at a time
_LEAST, _MOST = 2.0**-65, 1 - 2.0**-53  # of the numbers that kernels get: inside (0, 1)

Functionals = Mapping[str, Callable[[Any], Any]]


def run(
    kernel: Any,
    start: Any,
    *,
    n: SupportsIndex | None = None,
    chains: SupportsIndex | None = None,
    warm_up: SupportsIndex = 0,
    burn_in: SupportsIndex = 0,
    points: Driving | None = None,
    functionals: Functionals | None = None,
    keep_draws: bool = True,
    seed: SeedLike = None,
) -> Chains:
    """Run chains of a kernel.

    Parameters
    ----------
    kernel : Kernel
        What a step is.
    start : array_like, shape (d,) or (chains, d)
        Where all chains, or each of them, start.
    n : int, optional
        The steps that count; by default, and no other number, all steps that a finite driving sequence has.
    chains : int, optional
        How many; by default as many as starts, or 4. With driving sequences that couple chains, a multiple of what they
        couple.
    warm_up : int
        Steps before, in which the kernel may change its settings; all chains share them, and they are fixed afterwards.
    burn_in : int
        Steps after those, in which chains forget where they started. Warm-up and burn-in are always driven by
        independent numbers.
    points : Driving, optional
        What drives the steps that count; independent numbers by default.
    functionals : mapping of str to callable, optional
        Functions from positions (m, d) to values (m,) or (m, k), whose means over each chain are kept.
    keep_draws : bool
        Whether to keep the positions; without them there are only the means of `functionals`.
    seed : int or numpy.random.Generator, optional
        The same number gives the same bits; 0 by default.

    Returns
    -------
    Chains
        Positions, what the kernel told of its steps, and all settings.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above, or the kernel says so.

    Notes
    -----
    Memory: 8 n d bytes for each chain with `keep_draws`, besides 16 n for each of the kernel's own numbers. Speed: all
    chains advance together, so that a step costs a few calls of NumPy however many they are.

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, run
    >>> chains = run(RandomWalk(lambda x: -abs(x[:, 0])), [0.0], n=4000, chains=16, warm_up=500, seed=1)
    >>> estimate = chains.estimate(lambda x: abs(x[:, 0]))
    >>> abs(estimate.value - 1) < 4 * estimate.standard_error < 0.2
    True
    """
    driving = IndependentNumbers() if points is None else points
    if not isinstance(driving, Driving):
        raise TypeError(
            f"points must be a driving sequence, not {type(driving).__name__}; Permuted(...) makes one of point sets"
        )
    for name, functional in (functionals or {}).items():
        check_callable(f"functionals[{name!r}]", functional)
    positions = _starts(start, chains, driving.coupled)
    dims = kernel.dims(positions.shape[1])
    number = seed_number(seed)
    phases = [_core.replicate_seed(number, phase) for phase in range(3)]
    state = kernel.init(positions)
    kernel, state = _warm_up(kernel, state, integer("warm_up", warm_up, 0), phases[0])
    state = _burn_in(kernel, state, integer("burn_in", burn_in, 0), phases[1])
    steps = _steps(n, driving.length(dims))
    recorder = _Recorder(len(positions), steps, functionals or {}, keep_draws)
    stream = _stream(driving, dims, steps, len(positions), phases[2])
    state = _advance(kernel, state, stream, (dims, steps), recorder.record)
    return Chains(
        draws=recorder.draws,
        info=recorder.info,
        means=recorder.means(),
        kernel=kernel,
        points=driving,
        state=state,
        seed=number,
        steps_before=(int(warm_up), int(burn_in)),
    )


class _Recorder:
    """Keeps what is asked for, step by step."""

    def __init__(self, chains: int, n: int, functionals: Functionals, keep_draws: bool) -> None:
        self._shape = (chains, n)
        self._functionals = functionals
        self._sums: dict[str, Array] = {}
        self._keep = keep_draws
        self.draws: Array | None = None
        self.info: dict[str, Any] = {}

    def record(self, step: int, state: Any, info: Any) -> None:
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
            self._sums[name] = self._sums[name] + values if name in self._sums else values
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

    def means(self) -> dict[str, Array]:
        return {name: total / self._shape[1] for name, total in self._sums.items()}


def _starts(start: Any, chains: SupportsIndex | None, coupled: int) -> Array:
    array = np.asarray(start, np.float64)
    if array.ndim not in (1, 2) or not array.size:
        raise ValueError(f"start must have the shape (d,) or (chains, d), not {array.shape}")
    default = len(array) if array.ndim == 2 else max(4, coupled)
    count = default if chains is None else integer("chains", chains, 1)
    if array.ndim == 2 and len(array) != count:
        raise ValueError(f"there are {len(array)} starts for {count} chains")
    if count % coupled:
        raise ValueError(f"chains must be a multiple of the {coupled} that are coupled, not {count}")
    return np.array(np.broadcast_to(array, (count, array.shape[-1])))


def _steps(n: SupportsIndex | None, length: int | None) -> int:
    if n is not None:
        return integer("n", n, 1)
    if length is None:
        raise ValueError("n, the number of steps, must be given: the driving sequence has no end")
    return length


def _stream(driving: Driving, dims: int, n: int, chains: int, seed: int) -> Any:
    if dims == 0:  # deterministic kernels
        return lambda start, stop: np.empty((chains, stop - start, 0))
    return driving.stream(dims, n, chains // driving.coupled, seed)


def _advance(kernel: Kernel, state: Any, stream: Any, size: tuple[int, int], record: Any) -> Any:
    dims, n = size
    chains = len(state.position)
    block = max(1, _MOST_NUMBERS // (chains * max(dims, 1)))
    for start in range(0, n, block):
        uniforms = np.clip(stream(start, min(start + block, n)), _LEAST, _MOST)
        for step in range(uniforms.shape[1]):
            state, info = kernel.step(state, uniforms[:, step])
            record(start + step, state, info)
    return state


def _burn_in(kernel: Kernel, state: Any, steps: int, seed: int) -> Any:
    dims = kernel.dims(state.position.shape[1])
    stream = _stream(IndependentNumbers(), dims, steps, len(state.position), seed)
    return _advance(kernel, state, stream, (dims, steps), lambda *_: None)


def _warm_up(kernel: Kernel, state: Any, steps: int, seed: int) -> tuple[Kernel, Any]:
    chains, d = state.position.shape
    dims = kernel.dims(d)
    stream = _stream(IndependentNumbers(), dims, steps, chains, seed)
    windows = max(1, steps // _WINDOW) if steps else 0
    recorder = _Recorder(chains, steps, {}, True)
    for window in range(1, windows + 1):
        first, last = (window - 1) * _WINDOW, steps if window == windows else window * _WINDOW

        def shifted(start: int, stop: int, first: int = first) -> Array:
            return np.asarray(stream(first + start, first + stop))

        def put(step: int, state: Any, info: Any, first: int = first) -> None:
            recorder.record(first + step, state, info)

        state = _advance(kernel, state, shifted, (dims, last - first), put)
        kernel = kernel.adapted(recorder.warm_up(first, last, (window, windows)))
    return kernel, state
