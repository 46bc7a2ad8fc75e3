"""Korobov lattices: a whole lattice from one number."""

from .engine import Engine

__all__ = ["Korobov"]


class Korobov(Engine):
    """Korobov lattices: row i is i (1, a, a², …) / n, modulo 1.

    For a fixed number of points, where a number a is at hand. `construct_korobov` searches one for the dimension and
    the weights of a problem; vectors made component by component, as in `Lattice`, are better still.

    Parameters
    ----------
    d : int
        1 to 65,536.
    n : int, optional
        The number of points, 1 to 2^48. If it is not given, the first call of `random` says it.
    generator : sequence of one int, optional
        The number a, without a common divisor with n. By default the best of 16 in eight dimensions, which must be
        searched and takes 0.2 seconds for a million points; n is at most 2^20 then.
    scramble : {"shift", "shift_tent", "none"}
        "shift": one random shift modulo 1 of all points. "shift_tent": the same, then 1 - |2x - 1| in every
        coordinate, for smooth functions that are not periodic. "none": the lattice itself.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Integer arithmetic; measured, 0.4 nanoseconds per coordinate, as fast as memory.

    References: N. M. Korobov, Dokl. Akad. Nauk SSSR 124, 1207-1210 (1959).

    Examples
    --------
    >>> from evenlight.points import Korobov
    >>> (101 * Korobov(3, n=101, generator=[12], scramble="none").points(1, 3)).round().tolist()
    [[1.0, 12.0, 43.0], [2.0, 24.0, 86.0]]
    """

    sequence = "korobov"
    finite = True
