"""Niederreiter points: nets in any prime base and dimension."""

from .engine import Engine

__all__ = ["Niederreiter"]


class Niederreiter(Engine):
    """Niederreiter points: a (t, d)-sequence in any prime base.

    There is one irreducible polynomial over the integers modulo the base for each coordinate, and t is at most the sum
    of their degrees less 1: 0 if the base is at least d, as with `Faure`. In base 2, `Sobol` is the same
    idea with chosen direction numbers; choose a base between 2 and d to trade the size of balanced counts for t.

    Parameters
    ----------
    d : int
        1 to 1,024.
    base : int, optional
        A prime from 2 to 65,521; 2 by default.
    scramble : {"owen", "owen_exact", "linear", "linear_striped", "linear_i_binomial", "digit_permutation", \
"digital_shift", "shift", "none"}
        As in `Halton`; none but "shift" disturbs the net.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Warns
    -----
    UserWarning
        Once, if the first call of `random` asks for a number of rows that is not a power of the base.

    Notes
    -----
    The polynomials are found, not tabulated. Base 2 is as fast as `Sobol`.

    References: H. Niederreiter, J. Number Theory 30, 51-70 (1988); P. Bratley, B. L. Fox and H. Niederreiter, ACM
    TOMACS 2, 195-213 (1992).

    Examples
    --------
    >>> from evenlight.points import Niederreiter
    >>> Niederreiter(3, base=3, scramble="none").points(3, 5).round(4)
    array([[0.1111, 0.7778, 0.4444],
           [0.4444, 0.1111, 0.7778]])
    """

    sequence = "niederreiter"
