"""PCG64: the pseudo-random numbers that NumPy draws by default."""

from .always_random import AlwaysRandom

__all__ = ["Pcg"]


class Pcg(AlwaysRandom):
    """Independent points from PCG64 (XSL-RR 128/64), one stream for each dimension.

    Choose it where numbers must be those of other software: column j is what NumPy's `PCG64` draws from that
    column's state. `Independent` is faster.

    Parameters
    ----------
    d : int
        1 to 1,048,576.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    2 nanoseconds per coordinate; skipping ahead takes 128 steps at most.

    References: M. E. O'Neill, *PCG: a family of simple fast space-efficient statistically good algorithms*,
    HMC-CS-2014-0905 (2014).

    Examples
    --------
    >>> from evenlight.points import Pcg
    >>> Pcg(3, seed=1).points(10**15, 10**15 + 2).shape
    (2, 3)
    """

    sequence = "pcg"
