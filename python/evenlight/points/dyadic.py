"""Pairs of (0, 2)-sequences: every two consecutive coordinates as even as base 2 allows."""

from .engine import Engine

__all__ = ["Dyadic"]


class Dyadic(Engine):
    """Pairs of (0, 2)-sequences in base 2, each in an order of its own.

    Any 2^m rows from a multiple of 2^m on have one point of each pair of coordinates 2i, 2i + 1 in every
    elementary interval of area 2^-m. Choose it for chains of two-dimensional problems; `Sobol` is as good in its
    first pair, worse in later ones and better across pairs.

    Parameters
    ----------
    d : int
        1 to 65,536; an odd last coordinate is half of a pair.
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
    As fast as `Sobol`.

    References: I. M. Sobol', USSR Comput. Math. Math. Phys. 7(4), 86-112 (1967); T. Kollig and A. Keller, *Efficient
    multidimensional sampling*, Computer Graphics Forum 21, 557-563 (2002).

    Examples
    --------
    >>> from evenlight.points import Dyadic
    >>> x = Dyadic(6, seed=7).random(8)[:, 4:]
    >>> sorted(map(tuple, (x * (2, 4)).astype(int).tolist()))[:4]
    [(0, 0), (0, 1), (0, 2), (0, 3)]
    """

    sequence = "dyadic"
