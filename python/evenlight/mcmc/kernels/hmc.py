"""Hamiltonian Monte Carlo: long moves along the target's slopes. First choice for smooth targets with a gradient."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.gradients import Gradient, with_gradient
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.leapfrog import GradientState, gradient_state, leapfrog, tuned
from evenlight.mcmc.metric import root_of
from evenlight.mcmc.target import check_positive, moved

__all__ = ["HMC", "HamiltonianInfo"]


@dataclass(frozen=True, eq=False)
class HamiltonianInfo(Info):
    """What a trajectory has to tell."""

    energy_error: Array
    """Of the trajectory; its negative exponential has mean 1 in equilibrium. Infinite if it diverged."""
    gradients: Array
    """How many gradients it took."""


@dataclass(frozen=True, eq=False)
class HMC(Kernel):
    """Hamiltonian Monte Carlo with leapfrog steps [1]_ of fixed or randomized number.

    A step costs `steps` gradients, or (steps + 1) / 2 on average with a randomized length, and one value of the log
    density. In a warm-up, `step_size` becomes the one with which `target_acceptance` is accepted, `covariance` that of
    the target; then both stay.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    gradient : callable or {"finite-differences", "jax", "torch"}
        From positions (m, d) to gradients of the log density (m, d), or how to get them.
    step_size : float
        In units in which the covariance is the identity; stable below twice the least standard deviation in these.
    steps : int
        Leapfrog steps, or the most of them.
    randomize : bool
        Whether the number of steps is uniform on 1, ..., `steps`: avoids trajectories that return to where they began.
    covariance : array_like, shape (d, d) or (d,), optional
        The inverse mass matrix: a covariance or variances of the target; the identity by default.
    target_acceptance : float
        For the warm-up.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] S. Duane, A. D. Kennedy, B. J. Pendleton and D. Roweth, "Hybrid Monte Carlo", Phys. Lett. B 195(2), 216-222
       (1987).

    Examples
    --------
    >>> from evenlight.mcmc import HMC, run
    >>> kernel = HMC(lambda x: -0.5 * (x**2).sum(axis=1), lambda x: -x, step_size=0.3, steps=8)
    >>> chains = run(kernel, [0.0, 0.0, 0.0], n=500, chains=8, warm_up=100, seed=1)
    >>> estimate = chains.estimate(lambda x: x**2)
    >>> bool((abs(estimate.value - 1) < 0.2).all())
    True
    """

    name: ClassVar[str] = "hmc"

    log_density: LogDensity
    gradient: Gradient
    step_size: float = 0.1
    steps: int = 16
    randomize: bool = True
    covariance: Any = None
    target_acceptance: float = 0.8
    _functions: tuple[LogDensity, Callable[[Array], Array]] = field(init=False, repr=False)
    _root: Array | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        check_positive("step_size", self.step_size)
        integer("steps", self.steps, 1)
        if not 0 < self.target_acceptance < 1:
            raise ValueError(f"target_acceptance must be between 0 and 1, not {self.target_acceptance}")
        object.__setattr__(self, "_functions", with_gradient(self.log_density, self.gradient))
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """One for each coordinate of the momentum, one for the acceptance, one for a randomized length."""
        return d + 2 if self.randomize else d + 1

    def init(self, position: Any) -> GradientState:
        """Return positions, the target and its gradient there."""
        return gradient_state(*self._functions, position)

    def step(self, state: GradientState, uniforms: Array) -> tuple[GradientState, HamiltonianInfo]:
        """Draw a momentum, follow the trajectory, accept or stay."""
        chains, d = state.position.shape
        lengths = np.full(chains, self.steps)
        if self.randomize:
            lengths = 1 + np.floor(uniforms[:, d + 1] * self.steps).astype(np.int64)
        end = leapfrog(state, normals(uniforms[:, :d]), lengths, self.step_size, (*self._functions, self._root))
        accepted, probability = metropolis(-end.energy_error, uniforms[:, d])
        new = {"position": end.position, "log_density": end.log_density, "gradient": end.gradient}
        info = HamiltonianInfo(probability, accepted, end.energy_error, lengths.astype(np.float64))
        return moved(state, accepted, **new), info

    def adapted(self, warm_up: WarmUp) -> HMC:
        """Tune the step size, at times the covariance."""
        tuned_kernel: HMC = tuned(self, warm_up, self.target_acceptance, warm_up.positions.shape[2] ** -0.25)
        return tuned_kernel
