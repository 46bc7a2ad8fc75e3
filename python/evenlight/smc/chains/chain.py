"""What a Markov chain for Array-RQMC is: many copies advance together, each by a row of uniform numbers."""

from __future__ import annotations

from typing import Any

from evenlight.smc.state_space import Array

__all__ = ["Array", "MarkovChain"]


class MarkovChain:
    """A chain of a fixed number of steps, and what is paid on the way. Subclass it for one of your own.

    The expectation of the sum of all rewards is what `array_rqmc` estimates.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import smc
    >>> class Walk(smc.MarkovChain):  # how far a fair walk of 16 steps is from home
    ...     dims = step_uniforms = 1
    ...     steps = 16
    ...     def init(self, n):
    ...         return np.zeros((n, 1))
    ...     def step(self, t, states, u):
    ...         return states + np.where(u < 0.5, -1.0, 1.0)
    ...     def reward(self, t, states):
    ...         return np.abs(states[:, 0]) if t == self.steps else None
    >>> estimate = smc.array_rqmc(Walk(), chains=1024, seed=1)
    >>> abs(estimate.value - 3.1421) < 4 * estimate.standard_error
    True
    """

    dims: int
    """The number of coordinates of a state."""
    step_uniforms: int
    """How many uniform numbers make a step."""
    steps: int
    """How many steps there are."""

    def init(self, n: int) -> Array:
        """The start of n chains, shape (n, dims)."""
        raise NotImplementedError

    def step(self, t: int, states: Array, u: Array) -> Array:
        """States after step t, from 1 on, from those before and uniform numbers, shape (n, step_uniforms)."""
        raise NotImplementedError

    def reward(self, t: int, states: Array) -> Any:
        """What is paid after step t, shape (n,) or (n, k); None for nothing."""
        raise NotImplementedError

    def keys(self, t: int, states: Array) -> Array:
        """What chains are sorted by before step t, shape (n, k): what decides on their future; as a rule the states."""
        return states
