"""The Metropolis-adjusted Langevin algorithm: one step along the slope. Cost and reach between random walk and HMC."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable
from evenlight.mcmc.gradients import Gradient, with_gradient
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.leapfrog import GradientState, gradient_state, leapfrog, tuned
from evenlight.mcmc.metric import root_of
from evenlight.mcmc.target import check_positive, moved

__all__ = ["MALA"]


@dataclass(frozen=True, eq=False)
class MALA(Kernel):
    """Langevin proposals x + h^2/2 C grad + h C^(1/2) z with Metropolis–Hastings acceptance [1]_.

    A step costs one gradient and one value of the log density. In a warm-up, `step_size` becomes the one with which
    57 % are accepted [2]_, `covariance` that of the target; then both stay.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    gradient : callable or {"finite-differences", "jax", "torch"}
        From positions (m, d) to gradients of the log density (m, d), or how to get them.
    step_size : float
        h, in units in which the covariance is the identity.
    covariance : array_like, shape (d, d) or (d,), optional
        C: a covariance or variances of the target; the identity by default.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] G. O. Roberts and R. L. Tweedie, "Exponential convergence of Langevin distributions and their discrete
       approximations", Bernoulli 2(4), 341-363 (1996).
    .. [2] G. O. Roberts and J. S. Rosenthal, "Optimal scaling of discrete approximations to Langevin diffusions", J. R.
       Stat. Soc. B 60(1), 255-268 (1998).

    Examples
    --------
    >>> from evenlight.mcmc import MALA, run
    >>> kernel = MALA(lambda x: -0.5 * (x**2).sum(axis=1), lambda x: -x, step_size=1.2)
    >>> run(kernel, [0.0, 0.0], n=500, chains=4, seed=1).draws.shape
    (4, 500, 2)
    """

    name: ClassVar[str] = "mala"

    log_density: LogDensity
    gradient: Gradient
    step_size: float = 0.5
    covariance: Any = None
    _functions: tuple[LogDensity, Callable[[Array], Array]] = field(init=False, repr=False)
    _root: Array | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        check_positive("step_size", self.step_size)
        object.__setattr__(self, "_functions", with_gradient(self.log_density, self.gradient))
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """One for each coordinate, one for the acceptance."""
        return d + 1

    def init(self, position: Any) -> GradientState:
        """Return positions, the target and its gradient there."""
        return gradient_state(*self._functions, position)

    def step(self, state: GradientState, uniforms: Array) -> tuple[GradientState, Info]:
        """Propose along the slope; accept or stay. It is one leapfrog step, whose energy error is Hastings' ratio."""
        chains, d = state.position.shape
        end = leapfrog(
            state, normals(uniforms[:, :d]), np.ones(chains, np.int64), self.step_size, (*self._functions, self._root)
        )
        accepted, probability = metropolis(-end.energy_error, uniforms[:, d])
        new = {"position": end.position, "log_density": end.log_density, "gradient": end.gradient}
        return moved(state, accepted, **new), Info(probability, accepted)

    def adapted(self, warm_up: WarmUp) -> MALA:
        """Tune the step size, at times the covariance."""
        tuned_kernel: MALA = tuned(self, warm_up, 0.574, 1.65 * warm_up.positions.shape[2] ** (-1 / 6))
        return tuned_kernel
