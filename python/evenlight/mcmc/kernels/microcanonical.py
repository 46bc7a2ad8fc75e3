"""Microcanonical Monte Carlo: unit speed, step sizes over decades. For funnels and other targets of many scales."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.gradients import Gradient, with_gradient
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.leapfrog import GradientState, gradient_state, tuned
from evenlight.mcmc.metric import root_of, spread
from evenlight.mcmc.target import check_between_0_and_1, check_positive, evaluate, moved

__all__ = ["Microcanonical", "MicrocanonicalInfo"]


@dataclass(frozen=True, eq=False)
class MicrocanonicalInfo(Info):
    """What a trajectory has to tell."""

    energy_error: Array
    """The work of the trajectory; its negative exponential has mean 1 in equilibrium. Infinite outside the target."""
    gradients: Array
    """How many gradients it took."""
    step_size: Array
    """That of its steps."""


@dataclass(frozen=True, eq=False)
class Microcanonical(Kernel):
    """Metropolis-adjusted microcanonical Monte Carlo [2]_ with steps of random size [3]_.

    A direction is drawn, the density's slopes turn it while the speed stays the same (the isokinetic dynamics [1]_),
    and the end is accepted with the probability that makes this exact. A trajectory of `HMC` can climb no farther
    than its kinetic energy, about d / 2, and so must cross a funnel in many small moves; here nothing bounds the
    climb. Step sizes are drawn over `decades` powers of ten, so that some suit each place; where one scale suits the
    whole target, `HMC` and `NUTS` need fewer gradients.

    A step costs `steps` gradients and one value of the log density. In a warm-up, `step_size` becomes the one with
    which `target_acceptance` is accepted, `covariance` that of the target; then both stay. On a funnel, leave the
    warm-up out: a covariance of the whole is that of no place.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,); d at least 2.
    gradient : callable or {"finite-differences", "jax", "torch"}
        From positions (m, d) to gradients of the log density (m, d), or how to get them.
    step_size : float
        The largest, in units in which the covariance is the identity, at the speed sqrt(d).
    steps : int
        Of each trajectory. The more, the faster a funnel's mouth is left.
    decades : float
        Step sizes are log-uniform from `step_size` / 10^decades to `step_size`. With 0 all are the same, and
        trajectories may return to where they began.
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
    .. [1] G. Ver Steeg and A. Galstyan, "Hamiltonian dynamics with non-Newtonian momentum for rapid sampling", NeurIPS
       (2021); J. Robnik, G. B. De Luca, E. Silverstein and U. Seljak, "Microcanonical Hamiltonian Monte Carlo",
       J. Mach. Learn. Res. 24(311), 1-34 (2023).
    .. [2] J. Robnik, R. Cohn-Gordon and U. Seljak, "Metropolis adjusted microcanonical Hamiltonian Monte Carlo",
       arXiv:2503.01707 (2025).
    .. [3] R. M. Neal, "MCMC using Hamiltonian dynamics", Handbook of Markov Chain Monte Carlo, ch. 5 (2011).

    Examples
    --------
    The deviation of y is exp(x / 2):

    >>> import numpy as np
    >>> from evenlight.mcmc import Microcanonical, run
    >>> log_density = lambda q: -0.5 * (q[:, 0] ** 2 + q[:, 1] ** 2 * np.exp(-q[:, 0]) + q[:, 0])
    >>> slopes = lambda q: np.stack(
    ...     [0.5 * q[:, 1] ** 2 * np.exp(-q[:, 0]) - q[:, 0] - 0.5, -q[:, 1] * np.exp(-q[:, 0])], axis=1)
    >>> chains = run(Microcanonical(log_density, slopes, steps=20), [0.0, 0.0], n=400, chains=16, seed=1)
    >>> estimate = chains.estimate(lambda q: q[:, 0])
    >>> abs(estimate.value) < 4 * estimate.standard_error < 0.3
    True
    """

    name: ClassVar[str] = "microcanonical"

    log_density: LogDensity
    gradient: Gradient
    step_size: float = 0.6
    steps: int = 100
    decades: float = 2.0
    covariance: Any = None
    target_acceptance: float = 0.8
    _functions: tuple[LogDensity, Callable[[Array], Array]] = field(init=False, repr=False)
    _root: Array | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        check_positive("step_size", self.step_size)
        integer("steps", self.steps, 1)
        if not 0 <= self.decades < np.inf:
            raise ValueError(f"decades must be finite and at least 0, not {self.decades}")
        check_between_0_and_1("target_acceptance", self.target_acceptance)
        object.__setattr__(self, "_functions", with_gradient(self.log_density, self.gradient))
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """One for each coordinate of the direction, one for the acceptance, one for the step size."""
        return d + 2

    def init(self, position: Any) -> GradientState:
        """Return positions, the target and its gradient there."""
        state = gradient_state(*self._functions, position)
        if state.position.shape[1] < 2:
            raise ValueError("microcanonical trajectories need at least 2 dimensions: on a line they cannot turn")
        return state

    def step(self, state: GradientState, uniforms: Array) -> tuple[GradientState, MicrocanonicalInfo]:
        """Draw a direction and a step size, follow the trajectory, accept or stay."""
        d = state.position.shape[1]
        step_size = self.step_size * 10.0 ** (-self.decades * uniforms[:, d + 1])
        direction = normals(uniforms[:, :d])
        direction /= _norm(direction)[:, None]
        end, _, work = self.trajectory(state, direction, step_size * d**0.5)
        accepted, probability = metropolis(-work, uniforms[:, d])
        new = {"position": end.position, "log_density": end.log_density, "gradient": end.gradient}
        info = MicrocanonicalInfo(probability, accepted, work, np.full(len(work), float(self.steps)), step_size)
        return moved(state, accepted, **new), info

    def adapted(self, warm_up: WarmUp) -> Microcanonical:
        """Tune the step size, at times the covariance."""
        tuned_kernel: Microcanonical = tuned(self, warm_up, self.target_acceptance, 1.0)
        return tuned_kernel

    def trajectory(self, start: GradientState, direction: Array, h: Array) -> tuple[GradientState, Array, Array]:
        """Where chains are after steps over distances h, shape (chains,), their directions there, and the work.

        The work is minus the logarithm of the ratio that decides: of densities, times the change of volume. At unit
        speed no position leaves the numbers; where a gradient does, the work is infinite, and the rest of the
        trajectory does not matter.
        """
        log_density, gradient = self._functions
        x, slopes = start.position.copy(), start.gradient
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            u, work = self._turned(direction, slopes, 0.5 * h)
            for step in range(self.steps):
                x += h[:, None] * spread(u, self._root)
                slopes = gradient(x)
                u, done = self._turned(u, slopes, h if step < self.steps - 1 else 0.5 * h)
                work += done
            fine = np.isfinite(work)
            values = np.full(len(x), -np.inf)
            if fine.any():
                values[fine] = evaluate(log_density, x[fine])
            work = np.where(fine, work - values + start.log_density, np.inf)
        return GradientState(x, values, slopes), u, work

    def _turned(self, u: Array, slopes: Array, h: Array) -> tuple[Array, Array]:
        """Unit vectors u turned by the slopes over distances h, and minus the logarithm of the change of volume.

        With angle = h |slopes| / (d - 1) and e the slopes' direction: u + e (sinh angle + e.u (cosh angle - 1)) over
        its length, here times 2 exp(-angle), so that nothing overflows. Where slopes are no numbers, u stays, and the
        second answer is infinite.
        """
        force = spread(slopes, self._root, transposed=True)
        size = np.maximum(_norm(force), 1e-300)
        along = np.einsum("ij,ij->i", force, u) / size
        angle = h * size / (u.shape[1] - 1)
        small = np.exp(-angle)
        rest = 1 - small
        new = 2 * small[:, None] * u + (rest * (1 + small + along * rest) / size)[:, None] * force
        length = _norm(new)
        work = (u.shape[1] - 1) * (angle + np.log(0.5 * length))
        fine = np.isfinite(work)
        if not fine.all():
            return np.where(fine[:, None], new / length[:, None], u), np.where(fine, work, np.inf)
        return new / length[:, None], work


def _norm(rows: Array) -> Array:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", rows, rows)))
