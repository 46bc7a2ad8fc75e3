"""Random-walk Metropolis: a normal step, accepted or not. The first thing to try where there is no gradient."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.metric import root_of, spread
from evenlight.mcmc.target import DensityState, check_positive, density_state, evaluate, moved

__all__ = ["RandomWalk"]


@dataclass(frozen=True, eq=False)
class RandomWalk(Kernel):
    """Random-walk Metropolis with normal steps.

    A step costs one value of the log density. In a warm-up, the covariance becomes that of the target, and the scale
    the one with which 44 % (d = 1) to 23 % (many dimensions) of the steps are accepted; then both stay.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    scale : float, optional
        Factor of the step; 2.38 / sqrt(d) by default [1]_.
    covariance : array_like, shape (d, d) or (d,), optional
        Of a step of scale 1: a covariance or variances of the target; the identity by default.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] G. O. Roberts, A. Gelman and W. R. Gilks, "Weak convergence and optimal scaling of random walk Metropolis
       algorithms", Ann. Appl. Probab. 7(1), 110-120 (1997); adaptation: H. Haario, E. Saksman and J. Tamminen, "An
       adaptive Metropolis algorithm", Bernoulli 7(2), 223-242 (2001).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import RandomWalk
    >>> kernel = RandomWalk(lambda x: -0.5 * (x**2).sum(axis=1))
    >>> state = kernel.init(np.zeros((1, 2)))
    >>> state, info = kernel.step(state, np.array([[0.5, 0.9, 0.05]]))
    >>> state.position.round(2), info.acceptance.round(2)
    (array([[0.  , 2.16]]), array([0.1]))
    """

    name: ClassVar[str] = "random_walk"

    log_density: LogDensity
    scale: float | None = None
    covariance: Any = None
    _root: Array | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        if self.scale is not None:
            check_positive("scale", self.scale)
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """One for each coordinate of the step, one for the acceptance."""
        return d + 1

    def init(self, position: Any) -> DensityState:
        """Return positions and the target there."""
        return density_state(self.log_density, position)

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, Info]:
        """Propose a normal step; accept or stay."""
        d = state.position.shape[1]
        proposal = state.position + self._scale(d) * spread(normals(uniforms[:, :d]), self._root)
        log_density = evaluate(self.log_density, proposal)
        accepted, probability = metropolis(log_density - state.log_density, uniforms[:, d])
        return moved(state, accepted, position=proposal, log_density=log_density), Info(probability, accepted)

    def adapted(self, warm_up: WarmUp) -> RandomWalk:
        """The target's covariance, and a scale that is larger the more was accepted."""
        d = warm_up.positions.shape[2]
        wanted = 0.234 + 0.206 / d
        scale = self._scale(d) * float(np.exp(warm_up.gain * (warm_up.acceptance - wanted)))
        if warm_up.window < 4:  # of too few steps, a covariance says little
            return replace(self, scale=scale)
        return replace(self, scale=scale, covariance=warm_up.covariance())

    def _scale(self, d: int) -> float:
        return 2.38 / d**0.5 if self.scale is None else self.scale
