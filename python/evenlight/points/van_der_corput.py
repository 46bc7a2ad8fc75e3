"""The van der Corput sequence: one dimension, any base."""

from typing import Any, SupportsIndex

from .engine import Engine

__all__ = ["VanDerCorput"]


class VanDerCorput(Engine):
    """The van der Corput sequence: the digits of the row number, mirrored at the point.

    Any base^m rows from a multiple of that many on have one point in each of as many equal intervals. Choose it to
    drive something one-dimensional, in base 2 unless the problem has a base of its own.

    Parameters
    ----------
    d : int
        1, the default.
    base : int, optional
        2 to 65,536; 2 by default.
    scramble : {"owen", "owen_exact", "linear", "linear_striped", "linear_i_binomial", "digit_permutation", \
"digital_shift", "shift", "none"}
        As in `Halton`; the linear ones need a prime base.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.
    **arguments
        `optimization` as in `Engine`.

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
    Reference: J. G. van der Corput, Proc. Ned. Akad. Wet. 38, 813-821 (1935).

    Examples
    --------
    >>> from evenlight.points import VanDerCorput
    >>> VanDerCorput(base=10, scramble="none").points(8, 12).ravel().round(3).tolist()
    [0.8, 0.9, 0.01, 0.11]
    """

    sequence = "van_der_corput"

    def __init__(self, d: SupportsIndex = 1, **arguments: Any) -> None:
        super().__init__(d, **arguments)
