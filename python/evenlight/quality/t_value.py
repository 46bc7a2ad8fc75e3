"""The quality parameter t of a digital net, exactly."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core
from evenlight.points import Engine

__all__ = ["t_value"]


def t_value(
    net: Engine | npt.ArrayLike,
    m: SupportsIndex,
    dims: Sequence[SupportsIndex] | None = None,
    *,
    base: SupportsIndex = 2,
) -> int:
    """Return the quality parameter t of the first b^m points of a digital net in base b.

    Every elementary interval of volume b^(t - m) holds exactly b^t of these points, and t is the least number for which
    this is true: 0 is the best, m says nothing. Scrambles that keep nets do not change it.

    Parameters
    ----------
    net : Engine or array_like of int
        A sequence that has generating matrices, or these: in base 2 the columns as numbers of 64 bits, first digit in
        the most significant bit, shape (d, m), as `Engine.generating_matrices` returns them; in any prime base the
        digits, shape (d, m, m), with digit r of column k at ``[j, r, k]``.
    m : int
        The number of points is base^m; at least 0, at most the columns there are.
    dims : sequence of int, optional
        The coordinates of a projection; all by default.
    base : int, optional
        The base of an array of digits, a prime below 2^16. 2 by default.

    Returns
    -------
    int
        The parameter t, 0 to m.

    Raises
    ------
    TypeError
        If `net` is neither a sequence nor an array of integers.
    ValueError
        If the sequence is no digital net in base 2, its scramble does not keep nets, or an argument is not as above.

    Notes
    -----
    Exact, by linear algebra over all ways to share digits among coordinates. Measured for Sobol' points: 2^20 points
    in 10 dimensions take 0.03 seconds, in 30 dimensions 0.3; the smaller t, the longer.

    References: H. Niederreiter, Monatsh. Math. 104, 273-337 (1987); G. Pirsic and W. Ch. Schmid, J. Complexity 17,
    827-839 (2001).

    Examples
    --------
    >>> from evenlight.points import Sobol
    >>> from evenlight.quality import t_value
    >>> t_value(Sobol(5), 12)
    4
    >>> t_value(Sobol(5), 12, dims=[0, 1])
    0
    """
    depth, base = operator.index(m), operator.index(base)
    matrices = _matrices(net) if isinstance(net, Engine) else np.asarray(net)
    if matrices.dtype.kind not in "iu":
        raise TypeError(f"net must be a sequence or an array of integers, not of {matrices.dtype}")
    if matrices.ndim not in (2, 3) or (matrices.ndim == 2 and base != 2):
        raise ValueError(f"net must have shape (d, m) in base 2, or (d, m, m), not {matrices.shape} in base {base}")
    if not 0 <= depth <= min(matrices.shape[1:]):
        raise ValueError(f"m must be 0 to {min(matrices.shape[1:])}, the size of the matrices, not {depth}")
    chosen = matrices if dims is None else matrices[[_dimension(dim, len(matrices)) for dim in dims]]
    if len(chosen) == 0:
        raise ValueError("a net has at least one dimension")
    if (chosen < 0).any():
        raise ValueError("net must have no negative numbers")
    if chosen.ndim == 2:
        return _core.t_value(chosen[:, :depth].tolist(), depth)
    return _core.t_value_in_base(base, chosen[:, :depth, :depth].tolist(), depth)


def _matrices(engine: Engine) -> npt.NDArray[np.uint64]:
    if engine.scramble == "shift":
        raise ValueError(f"{engine!r} is no net: a shift modulo 1 does not keep nets")
    return engine.generating_matrices()


def _dimension(dim: SupportsIndex, dims: int) -> int:
    number = operator.index(dim)
    if not 0 <= number < dims:
        raise ValueError(f"dimension {number} of a net of {dims} dimensions")
    return number
