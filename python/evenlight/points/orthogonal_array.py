"""Orthogonal-array Latin hypercubes."""

from .always_random import Design

__all__ = ["OrthogonalArray"]


class OrthogonalArray(Design):
    """Orthogonal-array Latin hypercubes: even in all pairs, or triples, of coordinates.

    Any `strength` coordinates have exactly one point in each cell of a regular grid of p cells a side, and each
    coordinate alone has one in each of n slices. Main effects and interactions of up to that many coordinates
    leave the error. Choose it where a Latin hypercube is not enough and d too large for a net.

    Parameters
    ----------
    d : int
        1 to 46,338, and at most p + 1.
    n : int, optional
        The number of points, p^strength for a prime p, up to 2^31. If it is not given, the first call of `random`
        says it.
    strength : {2, 3}, optional
        2 by default.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Measured with AVX2, 17 nanoseconds per coordinate; any point costs the same.

    References: K. A. Bush, Ann. Math. Statist. 23, 426-434 (1952); A. B. Owen, Statistica Sinica 2, 439-452
    (1992); B. Tang, J. Amer. Statist. Assoc. 88, 1392-1397 (1993); W. Jarosz et al., Computer Graphics Forum
    38(4) (2019).

    Examples
    --------
    >>> from evenlight.points import OrthogonalArray
    >>> x = OrthogonalArray(4, seed=7).random(9)
    >>> sorted(map(tuple, (3 * x[:, [0, 3]]).astype(int).tolist()))[:4]
    [(0, 0), (0, 1), (0, 2), (1, 0)]
    """

    sequence = "orthogonal_array"
