"""Points as the core takes them: a C-contiguous array of float64 with a point in each row."""

import numpy as np
import numpy.typing as npt

__all__ = ["as_rows"]


def as_rows(x: npt.ArrayLike, name: str = "x") -> npt.NDArray[np.float64]:
    """Convert points, or refuse what cannot be points.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points; the core checks that all numbers are in [0, 1].
    name : str
        What the error calls them.

    Returns
    -------
    ndarray, shape (n, d)
        The same numbers, C-contiguous, float64.

    Raises
    ------
    ValueError
        If the array does not have two axes, of at least one point and one dimension.

    Examples
    --------
    >>> as_rows([[0, 1]]).dtype
    dtype('float64')
    """
    rows = np.ascontiguousarray(x, dtype=np.float64)
    if rows.ndim != 2 or rows.size == 0:
        raise ValueError(f"{name} must have shape (n, d) with n and d at least 1, not {np.shape(x)}")
    return rows
