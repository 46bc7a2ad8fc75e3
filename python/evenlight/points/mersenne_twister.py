"""MT19937: the pseudo-random numbers of most older software."""

from .always_random import AlwaysRandom

__all__ = ["MersenneTwister"]


class MersenneTwister(AlwaysRandom):
    """Independent points from MT19937, one stream for each dimension.

    Choose it only where numbers must be those of other software: column j is what ``numpy.random.RandomState(
    [low, high]).random_sample(n)`` draws for the two words of that column's key.

    Parameters
    ----------
    d : int
        1 to 65,536.
    n : int, optional
        The number of rows there are, 2^32 by default.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    7 nanoseconds per coordinate, but no random access: a row costs the making of all rows before it, unless the
    last request ended there.

    References: M. Matsumoto and T. Nishimura, ACM Trans. Model. Comput. Simul. 8(1), 3-30 (1998).

    Examples
    --------
    >>> from evenlight.points import MersenneTwister
    >>> MersenneTwister(3, seed=1).random(2).shape
    (2, 3)
    """

    sequence = "mersenne_twister"
