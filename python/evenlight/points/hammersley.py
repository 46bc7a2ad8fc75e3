"""Hammersley points: for a number of points that is known beforehand."""

from .engine import Engine

__all__ = ["Hammersley"]


class Hammersley(Engine):
    """Hammersley points: i / n, and then the coordinates of Halton's.

    One coordinate is perfectly even, and the others are those of one dimension fewer, so that the discrepancy is
    smaller than that of a sequence by a factor log n. With n = 2^m, the first two coordinates are a net.

    Parameters
    ----------
    d : int
        1 to 6,543.
    n : int, optional
        The number of points, 1 to 2^31. If it is not given, the first call of `random` says it.
    scramble : {"owen", "owen_exact", "linear", "linear_striped", "linear_i_binomial", "digit_permutation", \
"digital_shift", "shift", "none"}
        As in `Halton`; the first coordinate is scrambled in base 2.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Reference: J. M. Hammersley, Ann. New York Acad. Sci. 86, 844-874 (1960).

    Examples
    --------
    >>> from evenlight.points import Hammersley
    >>> Hammersley(2, n=4, scramble="none").points(0, 4)
    array([[0.  , 0.  ],
           [0.25, 0.5 ],
           [0.5 , 0.25],
           [0.75, 0.75]])
    """

    sequence = "hammersley"
    finite = True
