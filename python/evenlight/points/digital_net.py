"""Digital nets in base 2 from generating matrices of your own."""

from __future__ import annotations

from typing import Any, SupportsIndex

import numpy as np
import numpy.typing as npt

from .engine import Engine

__all__ = ["DigitalNet"]


class DigitalNet(Engine):
    """A digital net in base 2 from generating matrices of your own, with all scrambles and at the speed of `Sobol`.

    Choose it for nets from a search or a table, such as those of LatNet Builder or the LDData collection;
    `read_matrices` and `read_direction_numbers` read files of theirs.
    `evenlight.quality.t_value` says how even the net is.

    Parameters
    ----------
    d : int, optional
        The number of matrices to use, from the first on; all of them by default. At most 65,536.
    matrices : array_like of int, shape (d, m)
        The columns of the matrices, 1 to 64 of each: number k has the digits of point 2^k. There are 2^m points;
        with 64 columns there is no end to them.
    bits : int
        The digits of a column, 1 to 64. The first digit is the most significant of so many bits.
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

    See Also
    --------
    Engine.generating_matrices : The matrices of the nets that ship.

    Notes
    -----
    Reference: H. Niederreiter, Monatsh. Math. 104, 273-337 (1987).

    Examples
    --------
    Hammersley's points, of which the first coordinate counts and the second is a van der Corput sequence:

    >>> from evenlight.points import DigitalNet
    >>> DigitalNet(matrices=[[1, 2], [2, 1]], bits=2, scramble="none").random(4)
    array([[0.  , 0.  ],
           [0.25, 0.5 ],
           [0.5 , 0.25],
           [0.75, 0.75]])
    """

    sequence = "digital_net"

    def __init__(
        self, d: SupportsIndex | None = None, *, matrices: npt.ArrayLike, bits: SupportsIndex, **arguments: Any
    ) -> None:
        if not isinstance(matrices, np.ndarray):
            try:
                matrices = [list(columns) for columns in matrices]  # type: ignore[union-attr, arg-type]  # said below
            except TypeError:
                raise TypeError("matrices must be a list of columns for each dimension") from None
        dims = len(matrices) if d is None else d
        super().__init__(dims, matrices=matrices[: dims.__index__()], bits=bits, **arguments)
