"""What all sequences share: rows that are a pure function of their number, behind SciPy's protocol."""

import warnings
from typing import Any, ClassVar, Literal, Self, SupportsIndex

import numpy as np
import numpy.typing as npt
from scipy.stats import qmc

from evenlight import _core
from evenlight.arguments import SeedLike, integer, seed_number, threads

__all__ = ["Engine", "SeedLike"]

_INDICES = 2**64


class Engine(qmc.QMCEngine):
    """A sequence of points of the unit cube; the subclasses say which.

    A `scipy.stats.qmc.QMCEngine`, so that SciPy takes it wherever it takes its own, with random access
    besides: `points` gives any rows at the cost of those rows alone.

    Parameters
    ----------
    d : int
        The number of coordinates of a point.
    scramble : str or bool
        The randomization; as in SciPy, True for the default and False for "none".
    seed, rng : int or numpy.random.Generator, optional
        Two names for the same thing; give at most one. The same number always gives the same bits, on
        every machine; 0 by default. Numbers from 2^64 on are hashed. From a generator, one number is drawn.
    optimization : {None, "random-cd", "lloyd"}, optional
        What SciPy's engines offer: a post-processing of what `random` draws. It destroys the structure of nets.
    **options
        What only some sequences ask, in plain values; None leaves the choice to the sequence.

    Raises
    ------
    TypeError
        If an argument has the wrong type, or both seeds are given.
    ValueError
        If an argument has no meaning; the message says what is allowed.

    Warns
    -----
    UserWarning
        Once, if the first call of `random` draws other than a power of the base in which the points are balanced; the
        message names the next ones. ``warnings.filterwarnings("ignore", ".* are balanced in powers of")`` silences it.
    """

    sequence: ClassVar[str]
    """The name in the registry, the same as in Rust, on the command line and in reports."""

    finite: ClassVar[bool] = False
    """Whether the number of points must be known, as the option `n` or from the first call of `random`."""

    def __init__(
        self,
        d: SupportsIndex,
        *,
        scramble: str | bool = True,
        seed: SeedLike = None,
        rng: SeedLike = None,
        optimization: Literal["random-cd", "lloyd"] | None = None,
        **options: Any,
    ) -> None:
        if seed is not None and rng is not None:
            raise TypeError("seed and rng are two names for the same argument; give one of them")
        dims = integer("d", d, 0)
        self.seed = seed_number(rng if seed is None else seed)
        self.scramble = self._scramble(scramble)
        self._options: dict[str, Any] = {
            name: _plain(name, value) for name, value in options.items() if value is not None
        }
        self._core = self._build(dims)
        self._warned = False
        super().__init__(dims, optimization=optimization, rng=self.seed)
        # `scipy.integrate.qmc_quad` builds its replicates from these two.
        self._init_quad = self._spec()
        self.rng = np.random.default_rng(self.seed)

    @property
    def n(self) -> int | None:
        """The number of points there are; None if there is no end to them, or it is not known yet."""
        return None if self._core is None else self._core.count

    def points(
        self,
        start: SupportsIndex,
        stop: SupportsIndex,
        out: Any = None,
        *,
        replicates: SupportsIndex | None = None,
        xp: Any = None,
        workers: SupportsIndex = 1,
    ) -> Any:
        """Rows `start` to `stop`, the latter not included, whatever was drawn before.

        Parameters
        ----------
        start, stop : int
            0 <= start <= stop < 2^64, and `stop` at most `n` where there is an end.
        out : array of float64 or float32, shape (stop - start, d), optional
            C-contiguous array to write to, which spares a new large one its page faults; with `replicates`, of
            shape (replicates, stop - start, d). NumPy's, or any other in memory that exports DLPack, such as a
            PyTorch tensor. In single precision, the numbers are truncated.
        replicates : int, optional
            Write this many independent randomizations: number r has the bits of ``replicate(r).points(start, stop)``.
        xp : module, optional
            The array library of the result, such as `torch` or `jax.numpy`, by way of its `from_dlpack`; NumPy by
            default.
        workers : int, optional
            The most threads to use, -1 for all processors. The numbers do not depend on it.

        Returns
        -------
        array of float64, shape (stop - start, d) or (replicates, stop - start, d)
            Numbers in [0, 1), never 1: `out`, or a new array.

        Raises
        ------
        TypeError
            If `out` is not a writable array of float64 or float32, or both `out` and `xp` are given.
        ValueError
            If the range is not as above, `workers` is neither -1 nor at least 1, `out` has another shape or is not
            C-contiguous, or there is nothing random to replicate.

        Examples
        --------
        >>> from evenlight.points import Sobol
        >>> Sobol(2, scramble="none").points(2, 4)
        array([[0.25, 0.75],
               [0.75, 0.25]])
        >>> Sobol(2, seed=7).points(0, 8, replicates=3).shape
        (3, 8, 2)
        """
        first, last = self._rows(start, stop)
        count = threads(workers)
        shape: tuple[int, ...] = (last - first, int(self.d))
        if replicates is not None:
            shape = (self._replicates(replicates), *shape)
        if out is not None and xp is not None:
            raise TypeError("out and xp both say where the points go; give one of them")
        array = np.empty(shape) if out is None else _writable(out)
        if self.d == 0:
            pass  # as in SciPy, points of no coordinates exist
        elif replicates is None:
            self._core.fill(first, last, array, count)
        else:
            self._core.fill_replicates(self.seed, (first, last), shape[0], array, count)
        if out is not None:
            return out
        return array if xp is None or xp is np else xp.from_dlpack(array)

    def _rows(self, start: SupportsIndex, stop: SupportsIndex) -> tuple[int, int]:
        first, last = integer("start", start, 0), integer("stop", stop, 0)
        if not first <= last < _INDICES:
            raise ValueError(f"rows {first} to {last}: 0 <= start <= stop < 2^64 is needed")
        if self._core is None and self.d > 0:
            raise ValueError(f"{self!r} must know its number of points: {type(self).__name__}({self.d}, n=...)")
        if self.n is not None and last > self.n:
            raise ValueError(f"rows {first} to {last}: {self!r} has {self.n} points")
        return first, last

    def _replicates(self, replicates: SupportsIndex) -> int:
        number = integer("replicates", replicates, 1)
        if not self.is_random:
            raise ValueError(f"{self!r} has no randomness to replicate; choose a scramble other than 'none'")
        return number

    def generating_matrices(self) -> npt.NDArray[np.uint64]:
        """Return the generating matrices of a digital net in base 2, before any scramble.

        Returns
        -------
        ndarray of uint64, shape (d, m)
            The columns of each matrix: the digits of points 1, 2, 4, ..., first digit in the most significant bit. m is
            64, or less where there are 2^m points. What other software calls direction numbers, to the same bits if
            it takes 64; ``matrices >> np.uint64(64 - bits)`` for fewer.

        Raises
        ------
        ValueError
            If the points are no digital net in base 2.

        Examples
        --------
        >>> from evenlight.points import Sobol
        >>> [f"{column:.3f}" for column in Sobol(2).generating_matrices()[1, :4] / 2**64]
        ['0.500', '0.750', '0.625', '0.938']
        """
        matrices = None if self._core is None else self._core.generating_matrices()
        if matrices is None:
            raise ValueError(f"{self!r} has no generating matrices in base 2")
        return np.array(matrices, dtype=np.uint64)

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
        number = integer("r", r, 0)
        self._replicates(1)
        return self._other(int(self.d), _core.replicate_seed(self.seed, number))

    def _other(self, d: int, seed: int | None = None) -> Self:
        """The same sequence in so many dimensions, with this seed."""
        return type(self)(**{**self._spec(), "d": d}, seed=seed)

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
        self.num_generated += integer("n", n, 0)
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
        rows = integer("n", n, 0)
        if rows == 0 or self.d == 0:
            return np.empty((rows, self.d))
        if self._core is None:
            self._options = self._options | {"n": self.num_generated + rows}  # copies share what was there
            self._core = self._build(int(self.d))
        self._warn_of_imbalance(rows)
        drawn: npt.NDArray[np.float64] = self.points(self.num_generated, self.num_generated + rows)
        return drawn

    def _warn_of_imbalance(self, rows: int) -> None:
        base = self._core.base
        if base is None or self.num_generated > 0 or self._warned:
            return
        lower = 1
        while lower * base <= rows:
            lower *= base
        if lower != rows:
            self._warned = True
            warnings.warn(
                f"{type(self).__name__} points are balanced in powers of {base}: "
                f"take n = {lower * base} or {lower}, not {rows}",
                UserWarning,
                stacklevel=4,
            )

    def _scramble(self, scramble: str | bool) -> str:
        if scramble is True:
            return next(scrambles[0] for name, _, scrambles, *_ in _core.available_sequences() if name == self.sequence)
        if scramble is False:
            return "none"
        if not isinstance(scramble, str):
            raise TypeError(f"scramble must be a string, not {type(scramble).__name__}")
        return scramble

    def _build(self, dims: int) -> Any:
        if dims == 0 or (self.finite and "n" not in self._options):
            return None
        try:
            return _core.PointSet(self.sequence, dims, self.scramble, self.seed, **self._options)
        except TypeError:
            known = next(options for name, _, _, options, _ in _core.available_sequences() if name == self.sequence)
            for option in set(self._options) - set(known):
                has = ", ".join(["d", "scramble", "seed", "rng", "optimization", *known])
                raise TypeError(f"{type(self).__name__} has no argument {option!r}; it has: {has}") from None
            raise

    def _spec(self) -> dict[str, Any]:
        """Return the arguments of the constructor, without the seed."""
        return {"d": self.d, "scramble": self.scramble, **self._options}


def _plain(name: str, value: Any) -> Any:
    """Turn an option into the plain value it stands for: an integer, or lists of integers."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "u":
        return value.tolist()
    if np.iterable(value) and not isinstance(value, str):
        return [_plain(name, part) for part in value]
    return integer(name, value, 0)


def _writable(out: Any) -> npt.NDArray[Any]:
    if isinstance(out, np.ndarray):
        return out
    if not hasattr(out, "__dlpack__"):
        raise TypeError(f"out must be a numpy array or export DLPack, not {type(out).__name__}")
    try:
        array: npt.NDArray[Any] = np.from_dlpack(out)
    except (BufferError, RuntimeError, TypeError, ValueError) as error:  # on a GPU, with gradients, of odd types …
        raise TypeError(f"out must be an array that NumPy can view; {type(out).__name__} cannot be: {error}") from error
    if not array.flags.writeable:
        raise TypeError(f"out must be writable; {type(out).__name__} exports itself as read-only")
    return array
