"""Microcanonical Monte Carlo: unit speed, step sizes over decades. For funnels and other targets of many scales."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.gradients import Gradient, with_gradient
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.leapfrog import GradientState, gradient_state, tuned
from evenlight.mcmc.metric import root_of, spread
from evenlight.mcmc.target import check_positive, evaluate, moved

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

    A step costs (steps + 1) / 2 gradients on average, and one value of the log density. In a warm-up, `step_size`
    becomes the one with which `target_acceptance` is accepted, `covariance` that of the target; then both stay.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,); d at least 2.
    gradient : callable or {"finite-differences", "jax", "torch"}
        From positions (m, d) to gradients of the log density (m, d), or how to get them.
    step_size : float
        The largest, in units in which the covariance is the identity, at the speed sqrt(d).
    steps : int
        The most of a trajectory; their number is uniform on 1, ..., `steps`.
    decades : float
        Step sizes are log-uniform from `step_size` / 10^decades to `step_size`; 0 for steps of one size.
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
        if not 0 < self.target_acceptance < 1:
            raise ValueError(f"target_acceptance must be between 0 and 1, not {self.target_acceptance}")
        object.__setattr__(self, "_functions", with_gradient(self.log_density, self.gradient))
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """One for each coordinate of the direction, one for the acceptance, the length and the step size each."""
        return d + 3

    def init(self, position: Any) -> GradientState:
        """Return positions, the target and its gradient there."""
        state = gradient_state(*self._functions, position)
        if state.position.shape[1] < 2:
            raise ValueError("microcanonical trajectories need at least 2 dimensions: on a line they cannot turn")
        return state

    def step(self, state: GradientState, uniforms: Array) -> tuple[GradientState, MicrocanonicalInfo]:
        """Draw a direction, a length and a step size; follow the trajectory; accept or stay."""
        d = state.position.shape[1]
        lengths = 1 + np.floor(uniforms[:, d + 1] * self.steps).astype(np.int64)
        step_size = self.step_size * 10.0 ** (-self.decades * uniforms[:, d + 2])
        direction = normals(uniforms[:, :d])
        direction /= _norm(direction)[:, None]
        end, _, work = self.trajectory(state, direction, lengths, step_size * d**0.5)
        accepted, probability = metropolis(-work, uniforms[:, d])
        new = {"position": end.position, "log_density": end.log_density, "gradient": end.gradient}
        info = MicrocanonicalInfo(probability, accepted, work, lengths.astype(np.float64), step_size)
        return moved(state, accepted, **new), info

    def adapted(self, warm_up: WarmUp) -> Microcanonical:
        """Tune the step size, at times the covariance."""
        tuned_kernel: Microcanonical = tuned(self, warm_up, self.target_acceptance, 1.0)
        return tuned_kernel

    def trajectory(
        self, start: GradientState, direction: Array, lengths: NDArray[np.int64], distances: Array
    ) -> tuple[GradientState, Array, Array]:
        """Where chain i is after lengths[i] steps of distances[i], its direction there, and the work.

        The work is minus the logarithm of the ratio that decides: of densities, times the change of volume. Chains
        are sorted by length, so that those still under way come first. At unit speed no position leaves the numbers;
        where a gradient does, the work is infinite, and the rest of the trajectory does not matter.
        """
        log_density, gradient = self._functions
        order = np.argsort(-lengths, kind="stable")
        lengths, h = lengths[order], distances[order]
        x, slopes = start.position[order], start.gradient[order]
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            u, work = self._turned(direction[order], slopes, 0.5 * h)
            for step in range(int(lengths[0])):
                rows = slice(int(np.searchsorted(-lengths, -step)))  # those with more steps than that
                x[rows] += h[rows, None] * spread(u[rows], self._root)
                slopes[rows] = gradient(x[rows])
                share = np.where(lengths[rows] == step + 1, 0.5, 1.0)
                u[rows], done = self._turned(u[rows], slopes[rows], share * h[rows])
                work[rows] += done
            fine = np.isfinite(work)
            values = np.full(len(x), -np.inf)
            if fine.any():
                values[fine] = evaluate(log_density, x[fine])
            work = np.where(fine, work - values + start.log_density[order], np.inf)
        back = np.argsort(order)
        return GradientState(x[back], values[back], slopes[back]), u[back], work[back]

    def _turned(self, u: Array, slopes: Array, h: Array) -> tuple[Array, Array]:
        """Unit vectors u turned by the slopes over distances h, and minus the logarithm of the change of volume.

        Hyperbolic functions of angle = h |slopes| / (d - 1) are divided by exp(angle), so that none overflows. Where
        slopes are no numbers, the direction stays, and the second answer is infinite.
        """
        force = spread(slopes, self._root, transposed=True)
        size = _norm(force)
        toward = force / np.where(size > 0, size, 1.0)[:, None]
        angle = h * size / (u.shape[1] - 1)
        along = (toward * u).sum(axis=1)
        small = np.exp(-angle)
        cosh, sinh = 0.5 * (1 + small**2), 0.5 * (1 - small**2)
        stretch = cosh + along * sinh
        new = u * small[:, None] + toward * (sinh + along * (cosh - small))[:, None]
        new /= _norm(new)[:, None]
        fine = (stretch > 0) & np.isfinite(angle)
        work = (u.shape[1] - 1) * (angle + np.log(stretch))
        return np.where(fine[:, None], new, u), np.where(fine, work, np.inf)


def _norm(rows: Array) -> Array:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", rows, rows)))
