"""What all sequences share: rows that are a pure function of their number, behind SciPy's protocol."""

import operator
import os
from typing import Any, ClassVar, Self, SupportsIndex, TypeAlias, TypeVar, overload

import numpy as np
import numpy.typing as npt
from scipy.stats import qmc

from evenlight import _core

__all__ = ["Engine", "SeedLike"]

SeedLike: TypeAlias = SupportsIndex | np.random.Generator | None
"""A number from 0 to 2^64 - 1, a generator to draw one from, or None for 0."""

_Floats = TypeVar("_Floats", npt.NDArray[np.float64], npt.NDArray[np.float32])
_INDICES = 2**64


class Engine(qmc.QMCEngine):
    """A sequence of points of the unit cube; the subclasses say which.

    A `scipy.stats.qmc.QMCEngine`, so that SciPy takes it wherever it takes its own, with random access
    besides: `points` gives any rows at the cost of those rows alone.

    Parameters
    ----------
    d : int
        The number of coordinates of a point.
    scramble : str
        The randomization of the digits.
    seed, rng : int or numpy.random.Generator, optional
        Two names for the same thing; give at most one. The same number always gives the same bits, on
        every machine; 0 by default. From a generator, one number is drawn.

    Raises
    ------
    TypeError
        If an argument has the wrong type, or both seeds are given.
    ValueError
        If an argument has no meaning; the message says what is allowed.
    """

    sequence: ClassVar[str]
    """The name in the registry, the same as in Rust, on the command line and in reports."""

    def __init__(self, d: SupportsIndex, *, scramble: str, seed: SeedLike = None, rng: SeedLike = None) -> None:
        if seed is not None and rng is not None:
            raise TypeError("seed and rng are two names for the same argument; give one of them")
        dims = _integer("d", d, 1)
        self.seed = _seed(rng if seed is None else seed)
        self.scramble = scramble
        self._core = self._build(dims)
        super().__init__(dims)
        # `scipy.integrate.qmc_quad` builds its replicates from these two.
        self._init_quad = self._spec()
        self.rng = np.random.default_rng(self.seed)

    @overload
    def points(
        self, start: SupportsIndex, stop: SupportsIndex, out: None = None, *, workers: SupportsIndex = 1
    ) -> npt.NDArray[np.float64]: ...
    @overload
    def points(
        self, start: SupportsIndex, stop: SupportsIndex, out: _Floats, *, workers: SupportsIndex = 1
    ) -> _Floats: ...
    def points(
        self,
        start: SupportsIndex,
        stop: SupportsIndex,
        out: npt.NDArray[np.float64] | npt.NDArray[np.float32] | None = None,
        *,
        workers: SupportsIndex = 1,
    ) -> npt.NDArray[np.float64] | npt.NDArray[np.float32]:
        """Rows `start` to `stop`, the latter not included, whatever was drawn before.

        Parameters
        ----------
        start, stop : int
            0 <= start <= stop < 2^64.
        out : ndarray of float64 or float32, shape (stop - start, d), optional
            C-contiguous array to write to, which spares a new large one its page faults. In single
            precision, the numbers are truncated.
        workers : int, optional
            The most threads to use, -1 for all processors. The numbers do not depend on it.

        Returns
        -------
        ndarray, shape (stop - start, d)
            Numbers in [0, 1), never 1: `out`, or a new array of float64.

        Raises
        ------
        TypeError
            If `out` is not a writable array of float64 or float32.
        ValueError
            If the range is not as above, `workers` is neither -1 nor at least 1, or `out` has another
            shape or is not C-contiguous.

        Examples
        --------
        >>> from evenlight.points import Sobol
        >>> Sobol(2, scramble="none").points(2, 4)
        array([[0.25, 0.75],
               [0.75, 0.25]])
        """
        first, last = _integer("start", start, 0), _integer("stop", stop, 0)
        if not first <= last < _INDICES:
            raise ValueError(f"rows {first} to {last}: 0 <= start <= stop < 2^64 is needed")
        if out is None:
            out = np.empty((last - first, self.d))
        elif not isinstance(out, np.ndarray):
            raise TypeError(f"out must be a numpy array, not {type(out).__name__}")
        self._core.fill(first, last, out, _threads(workers))
        return out

    @property
    def is_random(self) -> bool:
        """Whether the seed matters."""
        return self.scramble != "none"

    def replicate(self, r: SupportsIndex) -> Self:
        """Randomize the same sequence anew, for error estimates from independent repetitions.

        Parameters
        ----------
        r : int
            The number of the repetition, at least 0. Different numbers give independent points; all of
            them are independent of the engine itself.

        Returns
        -------
        Engine
            A new engine at row 0, whose seed follows from this one's and `r` alone.

        Raises
        ------
        ValueError
            If nothing in the sequence is random.

        Examples
        --------
        >>> from evenlight.points import Sobol
        >>> means = [Sobol(2, seed=7).replicate(r).random(256).prod(axis=1).mean() for r in range(8)]
        >>> all(abs(mean - 0.25) < 0.001 for mean in means)
        True
        """
        number = _integer("r", r, 0)
        if not self.is_random:
            raise ValueError(f"{self!r} has no randomness to replicate; choose a scramble other than 'none'")
        return type(self)(**self._spec(), seed=_core.replicate_seed(self.seed, number))

    def fast_forward(self, n: SupportsIndex) -> Self:  # type: ignore[override]  # any integer will do
        """Skip the next `n` rows of `random`, at no cost.

        Parameters
        ----------
        n : int
            At least 0.

        Returns
        -------
        Engine
            The engine itself.
        """
        self.num_generated += _integer("n", n, 0)
        return self

    def reset(self) -> Self:
        """Let `random` begin with row 0 again.

        Returns
        -------
        Engine
            The engine itself.
        """
        self.num_generated = 0
        self.rng = np.random.default_rng(self.seed)
        return self

    def __repr__(self) -> str:
        """Return the expression that builds the engine."""
        arguments = "".join(f", {name}={value!r}" for name, value in self._spec().items() if name != "d")
        return f"{type(self).__name__}({self.d}{arguments}, seed={self.seed})"

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the compiled part, which the plain values build again."""
        return {name: value for name, value in self.__dict__.items() if name != "_core"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Build the compiled part again."""
        self.__dict__.update(state)
        self._core = self._build(int(self.d))

    def _random(  # type: ignore[override]  # any integer will do
        self, n: SupportsIndex = 1, *, workers: SupportsIndex = 1
    ) -> npt.NDArray[np.float64]:
        del workers  # SciPy's own engines take it; here one core outruns the memory
        rows = _integer("n", n, 0)
        return self.points(self.num_generated, self.num_generated + rows)

    def _build(self, dims: int) -> _core.PointSet:
        if not isinstance(self.scramble, str):
            raise TypeError(f"scramble must be a string, not {type(self.scramble).__name__}")
        return _core.PointSet(self.sequence, dims, self.scramble, self.seed)

    def _spec(self) -> dict[str, Any]:
        """Return the arguments of the constructor, without the seed."""
        return {"d": self.d, "scramble": self.scramble}


def _integer(name: str, value: SupportsIndex, least: int) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if number < least:
        raise ValueError(f"{name} must be at least {least}, not {number}")
    return number


def _threads(workers: SupportsIndex) -> int:
    number = _integer("workers", workers, -1)
    if number == 0:
        raise ValueError("workers must be at least 1, or -1 for all processors, not 0")
    return number if number > 0 else os.cpu_count() or 1


def _seed(seed: SeedLike) -> int:
    if seed is None:
        return 0
    if isinstance(seed, np.random.Generator):
        return int(seed.integers(_INDICES, dtype=np.uint64))
    number = _integer("seed", seed, 0)
    if number >= _INDICES:
        raise ValueError(f"seed must be below 2^64, not {number}")
    return number
