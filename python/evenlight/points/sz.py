"""Nested (0, s)-sequences: even in consecutive pairs, quadruples, and so on."""

from .engine import Engine

__all__ = ["Sz"]


class Sz(Engine):
    """Nested (0, 2)-, (0, 4)- and (0, 16)-sequences: pairs, quadruples and sixteens at once.

    Coordinates 2i, 2i + 1 are a (0, 2)-sequence in base 2, coordinates 4i to 4i + 3 a (0, 4)-sequence in base
    4, and 16i to 16i + 15 a (0, 16)-sequence in base 16. Choose it for integrands that nest or multiply functions
    of few coordinates each, as in rendering.

    Parameters
    ----------
    d : int
        1 to 65,536.
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
    As fast as `Sobol`. The properties are those of the SZ sequences; the matrices are Faure's over a tower of
    fields, with a choice of the bits that write a digit which nests them.

    References: A. Ahmed, M. Pharr, V. Ostromoukhov and H. Huang, *SZ sequences*, ACM Trans. Graph. (2025); H.
    Niederreiter, Monatsh. Math. 104, 273-337 (1987).

    Examples
    --------
    >>> from evenlight.points import Sz
    >>> x = Sz(4, seed=7).random(256)
    >>> len(set(map(tuple, (4 * x).astype(int).tolist())))
    256
    """

    sequence = "sz"
