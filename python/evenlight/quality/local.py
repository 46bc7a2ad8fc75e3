"""The error at given boxes: the local discrepancy."""

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows

__all__ = ["local_discrepancy"]


def local_discrepancy(
    x: npt.ArrayLike, corners: npt.ArrayLike, *, closed: bool = False
) -> npt.NDArray[np.float64] | np.float64:
    """By how much boxes anchored at the origin have too many points: (points inside) / n − volume.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1].
    corners : array_like, shape (m, d) or (d,)
        The upper corners of the boxes.
    closed : bool
        Whether points on a box's upper faces are inside; by default they are not.

    Returns
    -------
    ndarray, shape (m,), or float
        Positive where there are too many points; a number for a single corner. In [-1, 1].

    Raises
    ------
    ValueError
        If shapes do not match or a number is not in [0, 1].

    Notes
    -----
    O(n m d). This is the error of integrating the box's indicator function.

    Examples
    --------
    Thirteen of these 32 points are in a box of volume 0.42:

    >>> import numpy as np
    >>> from evenlight import quality
    >>> i = np.arange(32)
    >>> x = np.column_stack(((i + 0.5) / 32, (9 * i % 32 + 0.5) / 32))
    >>> print(f"{quality.local_discrepancy(x, [0.6, 0.7]):.5f}")
    -0.01375
    """
    single = np.ndim(corners) == 1
    found = _core.local_discrepancy(as_rows(x), as_rows(np.atleast_2d(corners), "corners"), closed)
    return found[0] if single else found
