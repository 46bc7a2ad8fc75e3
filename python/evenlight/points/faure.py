"""Faure points: the most even nets, in a prime base of at least d."""

from .engine import Engine

__all__ = ["Faure"]


class Faure(Engine):
    """Faure points: a (0, d)-sequence in a prime base.

    Any p^m rows from a multiple of p^m on have one point in each elementary interval in base p of volume p^-m, for
    all coordinates at once: no net is more even. As p is at least d, that takes many points in many dimensions; in
    few, Faure points are rivals of `Sobol`.

    Parameters
    ----------
    d : int
        1 to 65,521.
    base : int, optional
        A prime from d to 65,521; by default the smallest.
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
    References: H. Faure, Acta Arith. 41, 337-351 (1982); scrambles as in A. B. Owen, *Randomly permuted
    (t,m,s)-nets and (t,s)-sequences* (1995).

    Examples
    --------
    >>> from evenlight.points import Faure
    >>> Faure(5, scramble="none").points(5, 6).round(4)
    array([[0.04, 0.24, 0.44, 0.64, 0.84]])
    """

    sequence = "faure"
