"""Niederreiter-Xing points: the smallest quality parameter t in 4 to 11 dimensions, and up to 32."""

from .engine import Engine

__all__ = ["NiederreiterXing"]


class NiederreiterXing(Engine):
    """Niederreiter-Xing points in base 2, with the matrices of G. Pirsic.

    All coordinates together are more even than those of `Sobol`: the quality parameter t is 1, 2, 3, 4, 5, 6, 8 and 9
    in 4 to 11 dimensions, where that of a Sobol' sequence may reach 3, 5, 8, 11, 15, 19, 23 and 27. Single coordinates
    and pairs are less even. Choose it where all of some ten coordinates matter at once, and compare; from 14
    dimensions on it shows no advantage up to 2^20 points.

    Parameters
    ----------
    d : int
        1 to 32. The sequences of different d have different coordinates.
    scramble : {"owen", "owen_exact", "linear", "linear_striped", "linear_i_binomial", "digital_shift", "shift", "none"}
        As for `Sobol`; all but "shift" keep every balance.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Warns
    -----
    UserWarning
        Once, if the first call of `random` asks for a number of rows that is not a power of 2.

    Notes
    -----
    The published matrices have 30 columns of 30 digits: there are 2^30 points, and with the scramble "none" a
    coordinate has 30 digits. As fast as `Sobol`.

    References: H. Niederreiter and C. Xing, Finite Fields Appl. 2, 241-273 (1996); G. Pirsic, *A software
    implementation of Niederreiter-Xing sequences*, MCQMC 2000, 434-445, Springer (2002).

    Examples
    --------
    >>> from evenlight.points import NiederreiterXing
    >>> from evenlight.quality import t_value
    >>> x = NiederreiterXing(8, seed=7)
    >>> x.n == 2**30
    True
    >>> t_value(x, 14)
    5
    """

    sequence = "niederreiter_xing"
