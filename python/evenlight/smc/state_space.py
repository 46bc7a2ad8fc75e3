"""What a state-space model and a proposal are: states of many particles from blocks of uniform numbers.

The uniform numbers are an argument, which is what lets evenly spread points drive the particles. Subclass
`StateSpaceModel` for a model of your own; give it a `Proposal` if observations say more than its dynamics.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.warp import Gaussian

__all__ = ["Array", "Proposal", "StateSpaceModel", "normals"]

Array = NDArray[np.float64]

_GAUSSIAN = Gaussian()


def normals(u: Array) -> Array:
    """Standard normal numbers of uniform ones in [0, 1), of the same shape, by the inverse of the distribution.

    Parameters
    ----------
    u : ndarray of float64
        Of any shape.

    Returns
    -------
    ndarray of float64
        Of that shape.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import smc
    >>> smc.normals(np.array([0.5, 0.975])).round(2)
    array([0.  , 1.96])
    """
    return np.asarray(_GAUSSIAN.map(u[..., np.newaxis]))[..., 0]


class StateSpaceModel:
    """A hidden Markov chain and what is observed of it.

    Subclasses set the three numbers and write `init`, `move` and `log_observation`; guided filters and backward
    sampling need the densities `log_init` and `log_move` too. Time runs from 0; all methods are vectorized over
    particles, and pure functions of their arguments.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import smc
    >>> class Counts(smc.StateSpaceModel):  # Poisson counts whose rate is exp(x), x a random walk
    ...     dims = init_uniforms = move_uniforms = 1
    ...     def init(self, u):
    ...         return smc.normals(u)
    ...     def move(self, t, states, u):
    ...         return states + 0.3 * smc.normals(u)
    ...     def log_observation(self, t, previous, states, y):
    ...         return y * states[:, 0] - np.exp(states[:, 0])  # up to log y!
    >>> evidence = smc.filter(Counts(), [0, 1, 0, 2, 5], particles=1024, seed=1)
    >>> evidence.diagnostics["filtering_means"].shape
    (5, 1)
    """

    dims: int
    """The number of coordinates of a state."""
    init_uniforms: int
    """How many uniform numbers make a first state."""
    move_uniforms: int
    """How many uniform numbers make a move."""

    def init(self, u: Array) -> Array:
        """States at time 0, shape (n, dims), from uniform numbers in [0, 1), shape (n, init_uniforms)."""
        raise NotImplementedError

    def move(self, t: int, states: Array, u: Array) -> Array:
        """States at time t, shape (n, dims), from those before and uniform numbers, shape (n, move_uniforms)."""
        raise NotImplementedError

    def log_observation(self, t: int, previous: Array | None, states: Array, y: Any) -> Array:
        """The logarithm of the density of observation y, shape (n,), given states and those before (None at t = 0)."""
        raise NotImplementedError

    def log_init(self, states: Array) -> Array:
        """The logarithm of the density of `init`, shape (n,)."""
        raise NotImplementedError(f"{type(self).__name__} has no log_init, which guided filters need")

    def log_move(self, t: int, previous: Array, states: Array) -> Array:
        """The logarithm of the density of `move`, shape (n,), row by row."""
        raise NotImplementedError(f"{type(self).__name__} has no log_move, which guided filters and smoothing need")


class Proposal:
    """Another way to move particles, that knows the observation; weights make up for it.

    It takes as many uniform numbers as the model's own `init` and `move`, and must lead wherever the model does.

    Examples
    --------
    >>> from evenlight import smc
    >>> model = smc.LinearGaussian(0.9, 1.0, 1.0, 0.04)
    >>> best = smc.OptimalProposal(model)
    >>> evidence = smc.filter(model, [0.1, 0.4, -0.2], particles=256, proposal=best, seed=1)
    >>> abs(evidence.value - smc.kalman(model, [0.1, 0.4, -0.2]).log_likelihood) < 0.05
    True
    """

    def init(self, u: Array, y: Any) -> Array:
        """States at time 0, shape (n, dims), from uniform numbers."""
        raise NotImplementedError

    def move(self, t: int, states: Array, u: Array, y: Any) -> Array:
        """States at time t, shape (n, dims), from those before."""
        raise NotImplementedError

    def log_init(self, states: Array, y: Any) -> Array:
        """The logarithm of the density of `init`, shape (n,)."""
        raise NotImplementedError

    def log_move(self, t: int, previous: Array, states: Array, y: Any) -> Array:
        """The logarithm of the density of `move`, shape (n,)."""
        raise NotImplementedError
