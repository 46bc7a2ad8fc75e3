"""What a random coefficient is: a positive function of space, from a fixed number of uniform numbers."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Field"]

Array = NDArray[np.float64]


class Field(Protocol):
    """A random function on the unit interval or square.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import UniformField
    >>> field = UniformField(terms=2)
    >>> field.values(np.array([[0.5, 0.5]]), np.array([0.25, 0.75]))
    array([[1., 1.]])
    """

    terms: int
    """Uniform numbers it takes; the first matters most."""

    def values(self, u: Array, *places: Array) -> Array:
        """At uniform numbers, shape (n, k) with k up to `terms` (the other terms are left out), and m places.

        Places are one array of coordinates, shape (m,), for each dimension; values have shape (n, m) and are above 0.
        """
        ...
