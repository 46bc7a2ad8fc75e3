"""Hamiltonian Monte Carlo: long moves along the target's slopes. First choice for smooth targets with a gradient."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.gradients import Gradient, with_gradient
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.leapfrog import GradientState, gradient_state, leapfrog, tuned
from evenlight.mcmc.metric import root_of
from evenlight.mcmc.target import check_between_0_and_1, check_positive, moved

__all__ = ["HMC", "HamiltonianInfo"]

_DIVERGING = 1000.0  # as in Stan and nuts-rs


@dataclass(frozen=True, eq=False)
class HamiltonianInfo(Info):
    """What a trajectory has to tell."""

    energy_error: Array
    """Of the trajectory; its negative exponential has mean 1 in equilibrium. Infinite if it diverged."""
    gradients: Array
    """How many gradients it took."""
    diverging: NDArray[np.bool_]
    """Whether the energy error is above 1,000: steps too large for where it went."""


@dataclass(frozen=True, eq=False)
class HMC(Kernel):
    """Hamiltonian Monte Carlo with leapfrog steps [1]_ of fixed or randomized number.

    A step costs `steps` gradients, or (steps + 1) / 2 on average with a randomized length, and one value of the log
    density. In a warm-up, `step_size` becomes the one with which `target_acceptance` is accepted, `covariance` that of
    the target; then both stay.

    Where the scale of some coordinates depends on others, as in R. M. Neal's funnel, no step size suits, and
    `Chains.diagnostics` says so: sample coordinates whose scale is the same everywhere and map them back (see the
    examples), or use `Microcanonical`.

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

    The funnel, v with deviation 3 and y with deviation exp(v / 2), in standard normal coordinates; functions of the
    funnel's are functions of those after the map:

    >>> import numpy as np
    >>> to_funnel = lambda z: np.stack([3 * z[:, 0], np.exp(1.5 * z[:, 0]) * z[:, 1]], axis=1)
    >>> kernel = HMC(lambda z: -0.5 * (z**2).sum(axis=1), lambda z: -z, step_size=0.3, steps=10)
    >>> chains = run(kernel, [0.0, 0.0], n=500, chains=8, burn_in=50, seed=1)
    >>> chains.diagnostics(to_funnel).doubts
    ()
    >>> estimate = chains.estimate(lambda z: to_funnel(z)[:, 0] > 3)
    >>> abs(estimate.value - 0.1587) < 4 * estimate.standard_error < 0.1
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
        check_between_0_and_1("target_acceptance", self.target_acceptance)
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
        error = end.energy_error
        info = HamiltonianInfo(probability, accepted, error, lengths.astype(np.float64), error > _DIVERGING)
        return moved(state, accepted, **new), info

    def adapted(self, warm_up: WarmUp) -> HMC:
        """Tune the step size, at times the covariance."""
        tuned_kernel: HMC = tuned(self, warm_up, self.target_acceptance, warm_up.positions.shape[2] ** -0.25)
        return tuned_kernel
