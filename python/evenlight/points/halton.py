"""Halton points: for numbers of points that are not powers of 2."""

from .engine import Engine

__all__ = ["Halton"]


class Halton(Engine):
    """Halton points: the radical inverse of the row number in one prime for each dimension.

    No number of points is special, and the first 10 or so dimensions are well spread. In high
    dimensions scramble them, or prefer `Sobol`.

    Parameters
    ----------
    d : int
        1 to 6,542, the number of primes below 2^16.
    scramble : {"owen", "owen_exact", "linear", "linear_striped", "linear_i_binomial", "digit_permutation", \
"digital_shift", "shift", "none"}
        "owen": each digit is permuted according to all digits before it, by hashing; "owen_exact": with a uniform
        permutation of its own at every node, at a cost that grows with the prime. "linear": digits times a random lower
        triangular matrix, and shifted, modulo the prime; "linear_striped" and "linear_i_binomial" are special matrices.
        "digit_permutation": one permutation for each place, which is SciPy's scramble. "digital_shift": one random
        digit added at each place. "shift": one random shift modulo 1, also called Cranley-Patterson rotation.
        "none": the construction itself.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    References: J. H. Halton, Numer. Math. 2, 84-90 (1960); A. B. Owen, *Randomly permuted (t,m,s)-nets and
    (t,s)-sequences* (1995). Hashed permutations are random affine maps modulo the prime, which give the same mean and
    variance as uniform ones (J. Matousek, J. Complexity 14, 527-556, 1998).

    Examples
    --------
    >>> from evenlight.points import Halton
    >>> Halton(2, scramble="none").points(1, 3).round(4)
    array([[0.5   , 0.3333],
           [0.25  , 0.6667]])
    """

    sequence = "halton"
