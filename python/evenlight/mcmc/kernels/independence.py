"""Independence Metropolis–Hastings: proposals from a fixed density. When that is close to the target but wider."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar

from evenlight.arguments import check_callable
from evenlight.importance import Density, as_density
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, metropolis
from evenlight.mcmc.target import DensityState, density_state, evaluate, moved

__all__ = ["Independence"]


@dataclass(frozen=True, eq=False)
class Independence(Kernel):
    """Metropolis–Hastings whose proposals do not depend on the position.

    A step costs one value of the log density and two of the proposal's. Uniformly ergodic if target over proposal is
    bounded; where it is not, chains stay for very long where the ratio is large [1]_.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    proposal : density
        What `evenlight.importance.as_density` takes.

    Raises
    ------
    TypeError
        If an argument is not as above.

    References
    ----------
    .. [1] L. Tierney, "Markov chains for exploring posterior distributions", Ann. Stat. 22(4), 1701-1728 (1994).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import StudentT
    >>> from evenlight.mcmc import Independence, run
    >>> kernel = Independence(lambda x: -0.5 * (x**2).sum(axis=1), StudentT([0.0, 0.0], df=5))
    >>> bool(run(kernel, [0.0, 0.0], n=200, chains=4, seed=1).acceptance.min() > 0.7)
    True
    """

    name: ClassVar[str] = "independence"

    log_density: LogDensity
    proposal: Any
    _density: Density = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        object.__setattr__(self, "_density", as_density(self.proposal))

    def dims(self, d: int) -> int:
        """Those of the proposal, and one for the acceptance."""
        if d != self._density.d:
            raise ValueError(f"the proposal has {self._density.d} dimensions, the chains have {d}")
        return self._density.uniforms + 1

    def init(self, position: Any) -> DensityState:
        """Return positions and the target there."""
        return density_state(self.log_density, position)

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, Info]:
        """Propose; accept with the ratio of importance weights."""
        proposal = self._density.sample(uniforms[:, :-1])
        log_density = evaluate(self.log_density, proposal)
        log_ratio = log_density - state.log_density
        log_ratio = log_ratio + self._density.logpdf(state.position) - self._density.logpdf(proposal)
        accepted, probability = metropolis(log_ratio, uniforms[:, -1])
        return moved(state, accepted, position=proposal, log_density=log_density), Info(probability, accepted)
