"""Antithetic points: every point with its mirror image, for integrands that are nearly odd about their mean."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["antithetic"]

Array = NDArray[np.float64]


def antithetic(f: Callable[[Any], Any], domain: Any = None) -> Callable[[Array], Array]:
    """The function whose value at u is the mean of f at u and at 1 - u, of the same integral.

    Exact for functions that are linear in the uniform numbers; of no use for those that are even about 1/2. It costs
    two values of f per point.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...).
    domain : domain, optional
        What maps the unit cube to where f lives; give it here, not to `integrate`.

    Returns
    -------
    callable
        For `integrate`, on the unit cube.

    Notes
    -----
    J. M. Hammersley and K. W. Morton, Proc. Camb. Phil. Soc. 52, 449-475 (1956).

    Examples
    --------
    >>> import numpy as np
    >>> import evenlight
    >>> from evenlight.points import Independent
    >>> from evenlight.reduction import antithetic
    >>> evenlight.integrate(antithetic(lambda x: 3 * x[:, 0] - x[:, 1]), Independent(2), n=100).value
    1.0
    """

    def mirrored(u: Array) -> Array:
        both = np.concatenate([u, np.minimum(1.0 - u, np.nextafter(1.0, 0.0))])
        values = np.asarray(f(both if domain is None else domain.map(both)))
        mean = 0.5 * (values[: len(u)] + values[len(u) :])
        return np.asarray(mean if domain is None else mean * domain.volume)

    return mirrored
