"""Multi-jittered points, in pairs of coordinates."""

from .always_random import Design

__all__ = ["MultiJittered"]


class MultiJittered(Design):
    """Multi-jittered points: pairs of coordinates stratified on a grid and on both axes.

    n = columns x rows, as near to a square as n allows: each pair of coordinates has one point in each cell
    of that grid, and each coordinate one in each of n slices. A prime n has a single row, which leaves a
    Latin hypercube. Different pairs are independent.

    Parameters
    ----------
    d : int
        1 to 1,048,576; an odd last coordinate is half of a pair.
    n : int, optional
        The number of points, 1 to 2^31. If it is not given, the first call of `random` says it.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    Measured with AVX2, 10 nanoseconds per coordinate; any point costs the same.

    References: K. Chiu, P. Shirley and C. Wang, *Multi-jittered sampling*, Graphics Gems IV (1994).

    Examples
    --------
    >>> from evenlight.points import MultiJittered
    >>> x = MultiJittered(2, seed=7).random(6)
    >>> sorted((6 * x[:, 0]).astype(int).tolist())
    [0, 1, 2, 3, 4, 5]
    """

    sequence = "multi_jittered"
