"""Clark and Cameron's equation: the smallest that no scheme without Lévy areas follows with an order above 1/2."""

from __future__ import annotations

import math
from typing import SupportsIndex

import numpy as np
from numpy.typing import NDArray

from .path_sampler import PathSampler

__all__ = ["ClarkCameron"]

Array = NDArray[np.float64]


class ClarkCameron(PathSampler):
    """E cos X_2 for dX_1 = dW_1, dX_2 = X_1 dW_2 from 0: a test of antithetic coupling.

    Parameters
    ----------
    antithetic : bool
        Variances of level differences fall by 4 with it and by 2 without.
    horizon : float
        The time at the end.
    construction : {"incremental", "bridge", "pca"}
        How uniform numbers become Brownian motion.
    first_steps : int
        Time steps on level 0.

    Notes
    -----
    Cost: one unit per time step, of any path. References: J. M. C. Clark and R. J. Cameron, in *Stochastic Differential
    Systems*, 162-171 (1980); Giles and Szpruch (2014), see `PathSampler`.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import ClarkCameron
    >>> model = ClarkCameron()
    >>> round(model.known_value, 6)
    0.805018
    >>> coupled = model.sample(4, np.random.default_rng(1).random((2000, model.dims(4))))
    >>> bool(coupled.difference.std() < 0.02), coupled.cost
    (True, 80000.0)
    """

    def __init__(
        self,
        *,
        antithetic: bool = True,
        horizon: float = 1.0,
        construction: str = "incremental",
        first_steps: SupportsIndex = 1,
    ) -> None:
        self.name = f"clark_cameron {'antithetic' if antithetic else 'milstein'}"
        super().__init__(
            [0.0, 0.0],
            2,
            horizon=horizon,
            antithetic=antithetic,
            construction=construction,
            first_steps=first_steps,
        )

    @property
    def known_value(self) -> float:
        """1 / √cosh T: given W_1, X_2 is normal of variance ∫ W_1² dt, whose Laplace transform is known."""
        return 1.0 / math.sqrt(math.cosh(self.horizon))

    def step(self, t: float, x: Array, dw: Array, h: float) -> Array:
        """Milstein's without the Lévy area."""
        y = x + dw
        y[1] = x[1] + (x[0] + 0.5 * dw[0]) * dw[1]
        return y

    def payoff(self, x: Array) -> Array:
        """The cosine of the second component."""
        return np.asarray(np.cos(x[1]))
