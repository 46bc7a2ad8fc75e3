"""Progressive multi-jittered (0, 2) sequences, in pairs of coordinates."""

from .engine import Engine

__all__ = ["ProgressiveMultiJittered"]


class ProgressiveMultiJittered(Engine):
    """Progressive multi-jittered (0, 2) sequences ("pmj02"), in pairs of coordinates.

    Of the first 2^m rows, each pair has one in every elementary interval of area 2^-m; the first 4^k are
    jittered on the grid of 2^k x 2^k. Points are random within these limits. This is `Dyadic` with
    an Owen scramble, under the name that renderers know.

    Parameters
    ----------
    d : int
        1 to 65,536; an odd last coordinate is half of a pair.
    scramble : {"owen", "owen_exact"}
        As for `Sobol`.
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
    As fast as `Sobol`; no search and no tables.

    References: P. Christensen, A. Kensler and C. Kilpatrick, Computer Graphics Forum 37(4), 21-33 (2018); A. Helmer, P.
    Christensen and A. Kensler, *Stochastic generation of (t, s) sample sequences*, EGSR (2021).

    Examples
    --------
    >>> from evenlight.points import ProgressiveMultiJittered
    >>> x = ProgressiveMultiJittered(2, seed=7).random(16)
    >>> len(set(map(tuple, (4 * x).astype(int).tolist())))
    16
    """

    sequence = "progressive_multi_jittered"
