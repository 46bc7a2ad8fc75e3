"""Running chains: warm-up, burn-in, and the steps that count, driven by random or by evenly spread numbers."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any, SupportsIndex

import numpy as np

from evenlight import _core
from evenlight.arguments import SeedLike, check_callable, integer, seed_number

from .chains import Chains
from .driving import Driving, IndependentNumbers
from .kernel import Array, Kernel
from .recorder import Functionals, Recorder

__all__ = ["run"]

_WINDOW = 25  # steps between changes of settings in a warm-up
_MOST_NUMBERS = 2**20  # uniform numbers at a time
_LEAST, _MOST = 2.0**-65, 1 - 2.0**-53  # of the numbers that kernels get: inside (0, 1)


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
    resume: Chains | None = None,
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
    resume : Chains, optional
        What the same call gave for a smaller `n`: goes on where it ended, and gives the bits of one long run. Not with
        driving sequences that are balanced as a whole only.

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

    Not enough? The same call with more steps, and what there is:

    >>> kernel = RandomWalk(lambda x: -abs(x[:, 0]))
    >>> chains = run(kernel, [0.0], n=100, warm_up=100, seed=1)
    >>> more = run(kernel, [0.0], n=400, warm_up=100, seed=1, resume=chains)
    >>> more.n, bool((more.draws[:, :100] == chains.draws).all())
    (400, True)
    """
    driving = _driving(points)
    for name, functional in (functionals or {}).items():
        check_callable(f"functionals[{name!r}]", functional)
    positions = _starts(start, chains, driving.coupled)
    dims = kernel.dims(positions.shape[1])
    number = seed_number(seed)
    before = integer("warm_up", warm_up, 0), integer("burn_in", burn_in, 0)
    phases = [_core.replicate_seed(number, phase) for phase in range(3)]
    steps = _steps(n, driving.length(dims))
    recorder = Recorder(len(positions), steps, functionals or {}, keep_draws)
    given, done = kernel, 0
    if resume is None:
        kernel, state = _warm_up(kernel, kernel.init(positions), before[0], phases[0])
        state = _burn_in(kernel, state, before[1], phases[1])
    else:
        same = {"points": driving, "seed": number, "warm_up and burn_in": before, "kept draws": keep_draws}
        _check_resumed(resume, kernel, same | {"functionals": sorted(functionals or {}), "shape": positions.shape})
        if not steps > resume.n:
            raise ValueError(f"resume has {resume.n} steps already, n must be more, not {steps}")
        recorder.take(resume)
        kernel, state, done = resume.kernel, resume.state, resume.n
    stream = _stream(driving, dims, steps, len(positions), phases[2])
    state = _advance(kernel, state, stream, (dims, done, steps), recorder.record)
    return Chains(
        draws=recorder.draws,
        info=recorder.info,
        sums=recorder.sums,
        kernel=kernel,
        points=driving,
        state=state,
        seed=number,
        steps_before=before,
        given=given,
    )


def _driving(points: Driving | None) -> Driving:
    driving = IndependentNumbers() if points is None else points
    if not isinstance(driving, Driving):
        raise TypeError(
            f"points must be a driving sequence, not {type(driving).__name__}; Permuted(...) makes one of point sets"
        )
    return driving


def _check_resumed(earlier: Chains, kernel: Any, same: dict[str, Any]) -> None:
    """Refuse to go on with anything but what the earlier run did."""
    if not isinstance(earlier, Chains):
        raise TypeError(f"resume must be Chains of an earlier run, not {type(earlier).__name__}")
    if not earlier.points.independent_steps:
        raise ValueError(f"a run driven by {earlier.points!r} cannot grow: its numbers are balanced as a whole")
    differing = _differences(earlier.given, kernel)
    if differing:
        raise ValueError(f"resume is of another kernel: {differing} differs; functions must be the same objects")
    was = {
        "points": earlier.points,
        "seed": earlier.seed,
        "warm_up and burn_in": earlier.steps_before,
        "kept draws": earlier.draws is not None,
        "functionals": sorted(earlier.sums),
        "shape": earlier.state.position.shape,
    }
    for name, value in same.items():
        if was[name] != value:
            raise ValueError(f"resume is of another run: its {name} is {was[name]}, not {value}")


def _differences(one: Any, other: Any) -> str:
    """The first setting in which two kernels differ, or their kind; empty if they do not."""
    if one is other:
        return ""
    if type(one) is not type(other) or not is_dataclass(one):
        return f"its kind, {one.name!r} and not {other.name!r},"
    for each in fields(one):
        values = [getattr(kernel, each.name) for kernel in (one, other)]
        if each.init and values[0] is not values[1] and not np.array_equal(values[0], values[1]):
            return each.name
    return ""


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


def _advance(kernel: Kernel, state: Any, stream: Any, size: tuple[int, int, int], record: Any) -> Any:
    dims, first, n = size
    chains = len(state.position)
    block = max(1, _MOST_NUMBERS // (chains * max(dims, 1)))
    for start in range(first, n, block):
        uniforms = np.clip(stream(start, min(start + block, n)), _LEAST, _MOST)
        for step in range(uniforms.shape[1]):
            state, info = kernel.step(state, uniforms[:, step])
            record(start + step, state, info)
    return state


def _burn_in(kernel: Kernel, state: Any, steps: int, seed: int) -> Any:
    dims = kernel.dims(state.position.shape[1])
    stream = _stream(IndependentNumbers(), dims, steps, len(state.position), seed)
    return _advance(kernel, state, stream, (dims, 0, steps), lambda *_: None)


def _warm_up(kernel: Kernel, state: Any, steps: int, seed: int) -> tuple[Kernel, Any]:
    chains, d = state.position.shape
    dims = kernel.dims(d)
    stream = _stream(IndependentNumbers(), dims, steps, chains, seed)
    windows = max(1, steps // _WINDOW) if steps else 0
    recorder = Recorder(chains, steps, {}, True)
    for window in range(1, windows + 1):
        first, last = (window - 1) * _WINDOW, steps if window == windows else window * _WINDOW
        state = _advance(kernel, state, stream, (dims, first, last), recorder.record)
        kernel = kernel.adapted(recorder.warm_up(first, last, (window, windows)))
    return kernel, state
