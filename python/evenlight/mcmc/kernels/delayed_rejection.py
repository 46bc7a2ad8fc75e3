"""Delayed rejection: a second, smaller step where the first one is rejected. When no scale suits the whole target."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.metric import root_of, spread
from evenlight.mcmc.target import DensityState, check_between_0_and_1, check_positive, density_state, evaluate, moved

__all__ = ["DelayedRejection", "DelayedRejectionInfo"]


@dataclass(frozen=True, eq=False)
class DelayedRejectionInfo(Info):
    """What a step has to tell; `acceptance` and `accepted` are of the two stages together."""

    first_stage: Array
    """The probability with which the first proposal was accepted."""


@dataclass(frozen=True, eq=False)
class DelayedRejection(Kernel):
    """Random-walk Metropolis with normal steps, and a second try of a smaller step after each rejection [1]_.

    A step costs two values of the log density (all chains advance together, so that the second stage is computed for
    those that were rejected only). In a warm-up, the covariance becomes that of the target; the scales stay.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    scale : float, optional
        Factor of the first step; 2.38 / sqrt(d) by default.
    shrink : float
        Factor of the second step's scale over the first one's, below 1.
    covariance : array_like, shape (d, d) or (d,), optional
        Of a step of scale 1: a covariance or variances of the target; the identity by default.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] L. Tierney and A. Mira, "Some adaptive Monte Carlo methods for Bayesian inference", Stat. Med. 18(17-18),
       2507-2515 (1999); P. J. Green and A. Mira, Biometrika 88(4), 1035-1053 (2001).

    Examples
    --------
    >>> from evenlight.mcmc import DelayedRejection, run
    >>> kernel = DelayedRejection(lambda x: -0.5 * (x**2).sum(axis=1), scale=3.0)
    >>> chains = run(kernel, [0.0, 0.0], n=200, chains=8, seed=1)
    >>> bool(chains.acceptance.mean() > 2 * chains.info["first_stage"].mean())
    True
    """

    name: ClassVar[str] = "delayed_rejection"

    log_density: LogDensity
    scale: float | None = None
    shrink: float = 0.2
    covariance: Any = None
    _root: Array | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        if self.scale is not None:
            check_positive("scale", self.scale)
        check_between_0_and_1("shrink", self.shrink)
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """For each stage one for each coordinate and one for the acceptance."""
        return 2 * (d + 1)

    def init(self, position: Any) -> DensityState:
        """Return positions and the target there."""
        return density_state(self.log_density, position)

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, DelayedRejectionInfo]:
        """Try a large step; where it is rejected, a small one."""
        d = state.position.shape[1]
        scale = 2.38 / d**0.5 if self.scale is None else self.scale
        z = normals(uniforms[:, :d])
        first = state.position + scale * spread(z, self._root)
        log_first = evaluate(self.log_density, first)
        accepted, probability = metropolis(log_first - state.log_density, uniforms[:, d])
        after = moved(state, accepted, position=first, log_density=log_first)
        rows = np.flatnonzero(~accepted)
        rescued, second = np.zeros(len(z), bool), np.zeros(len(z))
        if len(rows):
            u = uniforms[rows, d + 1 :]
            step = self.shrink * normals(u[:, :d])
            proposal = state.position[rows] + scale * spread(step, self._root)
            log_proposal = evaluate(self.log_density, proposal)
            # From the second proposal, the first one is z - step away in units in which steps are standard normal.
            log_ratio = log_proposal - state.log_density[rows]
            log_ratio += 0.5 * ((z[rows] ** 2).sum(axis=1) - ((z[rows] - step) ** 2).sum(axis=1))
            log_ratio += _log_rejection(log_first[rows], log_proposal) - np.log1p(-probability[rows])
            rescued[rows], second[rows] = metropolis(log_ratio, u[:, d])
            log_density, position = after.log_density.copy(), after.position.copy()
            taken = rows[rescued[rows]]
            position[taken], log_density[taken] = proposal[rescued[rows]], log_proposal[rescued[rows]]
            after = DensityState(position, log_density)
        both = probability + (1 - probability) * second
        return after, DelayedRejectionInfo(both, accepted | rescued, probability)

    def adapted(self, warm_up: WarmUp) -> DelayedRejection:
        """The target's covariance."""
        return self if warm_up.window < 4 else replace(self, covariance=warm_up.covariance())


def _log_rejection(proposed: Array, current: Array) -> Array:
    """The logarithm of 1 less the probability of acceptance; minus infinity where acceptance is certain.

    Where the second proposal is outside the target, the ratio is infinite or no number, and the step is rejected.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        probability = np.exp(np.minimum(np.nan_to_num(proposed - current, nan=np.inf), 0.0))
        return np.asarray(np.log1p(-probability))
