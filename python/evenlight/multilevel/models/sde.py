"""A stochastic differential equation of your own: drift, diffusion, and the quantity you want the mean of."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from .path_sampler import PathSampler
from .schemes import SCHEMES, Equation

__all__ = ["StochasticDifferentialEquation"]

Array = NDArray[np.float64]


class StochasticDifferentialEquation(PathSampler):
    """E payoff(X) for dX = a(t, X) dt + b(t, X) dW from a fixed start; level l has 2^l times the steps of level 0.

    All functions are called on blocks of n paths, components first, so that ``s, v = x`` takes a state apart.

    Parameters
    ----------
    drift : callable
        From a time and states, shape (d, n), to a(t, x), shape (d, n).
    diffusion : callable
        The same to b(t, x), shape (d, m, n) for m noises; or (d, n) if every component has a noise of its own.
    start : array_like, shape (d,)
        X at time 0; a number if d is 1.
    payoff : callable
        From X at the end, shape (d, n), to values, shape (n,); with `whole_path` from X at all times, shape
        (steps + 1, d, n).
    horizon : float
        The time at the end.
    scheme : {"milstein", "euler", "antithetic_milstein"}
        "euler": variances of level differences fall by 2. "milstein": by 4 for smooth payoffs, if there is one noise
        or the noises commute. "antithetic_milstein": by 4 without that condition, for twice the fine steps.
    derivative : callable, optional
        For Milstein's scheme: from a time and states to ∂b_ij/∂x_k, shape (d, m, d, n). Otherwise by central
        differences, which takes two values of b per noise.
    whole_path : bool
        What `payoff` takes.
    construction : {"incremental", "bridge", "pca"}
        How uniform numbers become Brownian motion.
    first_steps : int
        Time steps on level 0.

    Raises
    ------
    ValueError
        If a name is unknown, a number impossible, or a function returns another shape.

    Notes
    -----
    Cost: one unit per time step, of any path. References: see `schemes` and `PathSampler`.

    Examples
    --------
    Mean reversion, E X_1 = 1 + (2 - 1) / e:

    >>> import numpy as np
    >>> from evenlight.multilevel.models import StochasticDifferentialEquation
    >>> model = StochasticDifferentialEquation(
    ...     lambda t, x: 1.0 - x, lambda t, x: 0.3 * x, start=2.0, payoff=lambda x: x[0]
    ... )
    >>> coupled = model.sample(5, np.random.default_rng(1).random((2000, model.dims(5))))
    >>> round(float(coupled.fine.mean()), 1), bool(coupled.difference.std() < 0.02)
    (1.4, True)
    """

    def __init__(
        self,
        drift: Callable[[float, Array], Any],
        diffusion: Callable[[float, Array], Any],
        start: Any,
        payoff: Callable[[Array], Any],
        *,
        horizon: float = 1.0,
        scheme: str = "milstein",
        derivative: Callable[[float, Array], Any] | None = None,
        whole_path: bool = False,
        construction: str = "incremental",
        first_steps: SupportsIndex = 1,
    ) -> None:
        if scheme not in SCHEMES:
            raise ValueError(f"unknown scheme {scheme!r}; known: {', '.join(SCHEMES)}")
        self._equation = Equation(drift, diffusion, derivative)
        self._scheme = SCHEMES[scheme]
        self._payoff = payoff
        self.whole_path = whole_path
        self.name = f"sde {scheme}"
        column = np.atleast_1d(np.asarray(start, np.float64)).reshape(-1, 1)
        self._equation.a(0.0, column)
        super().__init__(
            start,
            self._equation.b(0.0, column).shape[1],
            horizon=horizon,
            antithetic=self._scheme.antithetic,
            construction=construction,
            first_steps=first_steps,
        )

    def step(self, t: float, x: Array, dw: Array, h: float) -> Array:
        """One step of the scheme."""
        return self._scheme.step(self._equation, t, x, dw, h)

    def payoff(self, x: Array) -> Array:
        """The user's quantity."""
        return np.asarray(self._payoff(x))
