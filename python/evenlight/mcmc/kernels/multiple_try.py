"""Multiple-try Metropolis: of several steps, the likeliest most often. Where values come cheap in blocks."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np
from scipy import special

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, WarmUp, metropolis, normals
from evenlight.mcmc.metric import root_of, spread
from evenlight.mcmc.target import DensityState, check_positive, density_state, evaluate, moved

__all__ = ["MultipleTry"]


@dataclass(frozen=True, eq=False)
class MultipleTry(Kernel):
    """Multiple-try Metropolis with normal steps, weighted by the target [1]_.

    A step costs 2 k - 1 values of the log density, in two blocks. In a warm-up, the covariance becomes that of the
    target, and the scale the one with which about 40 % are accepted; then both stay.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    tries : int
        k, at least 2.
    scale : float, optional
        Factor of a step; 2.38 / sqrt(d) by default.
    covariance : array_like, shape (d, d) or (d,), optional
        Of a step of scale 1: a covariance or variances of the target; the identity by default.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] J. S. Liu, F. Liang and W. H. Wong, "The multiple-try method and local optimization in Metropolis sampling",
       J. Am. Stat. Assoc. 95(449), 121-134 (2000).

    Examples
    --------
    >>> from evenlight.mcmc import MultipleTry, run
    >>> kernel = MultipleTry(lambda x: -0.5 * (x**2).sum(axis=1), tries=5, scale=3.0)
    >>> bool(run(kernel, [0.0, 0.0], n=200, chains=8, seed=1).acceptance.mean() > 0.4)
    True
    """

    name: ClassVar[str] = "multiple_try"

    log_density: LogDensity
    tries: int = 5
    scale: float | None = None
    covariance: Any = None
    _root: Array | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        integer("tries", self.tries, 2)
        if self.scale is not None:
            check_positive("scale", self.scale)
        object.__setattr__(self, "_root", root_of(self.covariance))

    def dims(self, d: int) -> int:
        """One for each coordinate of the 2 k - 1 points, one for the choice, one for the acceptance."""
        return (2 * self.tries - 1) * d + 2

    def init(self, position: Any) -> DensityState:
        """Return positions and the target there."""
        return density_state(self.log_density, position)

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, Info]:
        """Choose one of k points by the target, and compare with k points around it, the old position among them."""
        chains, d = state.position.shape
        forth = uniforms[:, : self.tries * d].reshape(chains, self.tries, d)
        back = uniforms[:, self.tries * d : -2].reshape(chains, self.tries - 1, d)
        proposals, log_proposals = self._around(state.position, forth)
        total = special.logsumexp(log_proposals, axis=1)
        possible = np.isfinite(total)
        shares = np.exp(log_proposals - np.where(possible, total, 0.0)[:, None])
        chosen = (shares.cumsum(axis=1) < uniforms[:, -2:-1]).sum(axis=1)
        rows = np.arange(chains)
        chosen = np.where(possible, np.minimum(chosen, self.tries - 1), 0)
        proposal, log_density = proposals[rows, chosen], log_proposals[rows, chosen]
        _, log_references = self._around(proposal, back)
        references = special.logsumexp(np.column_stack([log_references, state.log_density]), axis=1)
        accepted, probability = metropolis(total - references, uniforms[:, -1])
        return moved(state, accepted, position=proposal, log_density=log_density), Info(probability, accepted)

    def adapted(self, warm_up: WarmUp) -> MultipleTry:
        """The target's covariance, and a scale that is larger the more was accepted."""
        scale = self._scale(warm_up.positions.shape[2]) * float(np.exp(warm_up.gain * (warm_up.acceptance - 0.4)))
        if warm_up.window < 4:
            return replace(self, scale=scale)
        return replace(self, scale=scale, covariance=warm_up.covariance())

    def _around(self, centers: Array, uniforms: Array) -> tuple[Array, Array]:
        """Points around each chain's center, and the target there."""
        chains, tries, d = uniforms.shape
        steps = spread(normals(uniforms.reshape(-1, d)), self._root).reshape(uniforms.shape)
        points = centers[:, None] + self._scale(d) * steps
        return points, evaluate(self.log_density, points.reshape(-1, d)).reshape(chains, tries)

    def _scale(self, d: int) -> float:
        return 2.38 / d**0.5 if self.scale is None else self.scale
