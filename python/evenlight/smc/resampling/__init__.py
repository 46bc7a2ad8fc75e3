"""Resampling schemes: how often each particle is drawn. One scheme, one file.

All are unbiased: particle i is drawn n times its weight in the mean. They differ in how much the numbers vary.
"""

from collections.abc import Callable

from . import multinomial, residual, stratified, systematic
from .inverse_cdf import Array, Indices

__all__ = ["RESAMPLING", "resample"]

RESAMPLING: dict[str, Callable[[Array, Array, int], Indices]] = {
    "systematic": systematic.ancestors,
    "stratified": stratified.ancestors,
    "residual": residual.ancestors,
    "multinomial": multinomial.ancestors,
}
"""From weights, shape (n,), uniform numbers, shape (m,), and m, to the m indices that are drawn, ascending."""


def resample(name: str, weights: Array, u: Array) -> Indices:
    """Draw indices by the name of a scheme.

    Parameters
    ----------
    name : {"systematic", "stratified", "residual", "multinomial"}
        The one that varies least comes first.
    weights : ndarray of float64, shape (n,)
        Not negative, with a sum above 0.
    u : ndarray of float64, shape (m,)
        Independent uniform numbers in [0, 1), as many as indices are wanted; "systematic" uses the first alone.

    Returns
    -------
    ndarray of int, shape (m,)
        Indices in ascending order; the mean number of each is m times its weight.

    Notes
    -----
    Cost O(n + m), for "multinomial" and "residual" O(n + m log m). References: N. J. Gordon, D. J. Salmond and A. F. M.
    Smith, IEE Proc. F 140(2), 107-113 (1993); G. Kitagawa, J. Comput. Graph. Stat. 5(1), 1-25 (1996); J. S. Liu and R.
    Chen, J. Am. Stat. Assoc. 93, 1032-1044 (1998); J. Carpenter, P. Clifford and P. Fearnhead, IEE Proc. 146(1), 2-7
    (1999).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.smc import resample
    >>> resample("systematic", np.array([0.5, 0.125, 0.375]), np.array([0.3, 0.9, 0.1, 0.2])).tolist()
    [0, 0, 1, 2]
    """
    if name not in RESAMPLING:
        raise ValueError(f"unknown resampling {name!r}; known: {', '.join(RESAMPLING)}")
    return RESAMPLING[name](weights, u, len(u))
