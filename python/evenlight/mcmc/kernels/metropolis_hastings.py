"""Metropolis–Hastings with any proposal: for when you know moves that suit the target, on finite spaces too."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable, integer
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, metropolis
from evenlight.mcmc.target import DensityState, density_state, evaluate, moved

__all__ = ["MetropolisHastings", "Proposal"]


@dataclass(frozen=True, eq=False)
class Proposal:
    """A move: how it is drawn, and how likely it is.

    Attributes
    ----------
    uniforms : int
        How many uniform numbers it takes.
    draw : callable
        From positions (m, d) and uniform numbers (m, uniforms) to proposed positions (m, d).
    log_density : callable, optional
        ``log_density(y, x)``: the logarithm of the density, or probability, of proposing y from x, both (m, d), as an
        array (m,); terms that are the same from x to y and back may be missing. None if the proposal is symmetric.

    Examples
    --------
    >>> from evenlight.mcmc import Proposal
    >>> import numpy as np
    >>> factor = Proposal(1, lambda x, u: x * 4 ** (u - 0.5), lambda y, x: -np.log(y[:, 0]))
    >>> factor.draw(np.array([[2.0]]), np.array([[0.75]])).round(2)
    array([[2.83]])
    """

    uniforms: int
    draw: Callable[[Any, Any], Any]
    log_density: Callable[[Any, Any], Any] | None = None

    def __post_init__(self) -> None:
        integer("uniforms", self.uniforms, 1)
        check_callable("draw", self.draw)
        if self.log_density is not None:
            check_callable("log_density", self.log_density)


@dataclass(frozen=True, eq=False)
class MetropolisHastings(Kernel):
    """Metropolis–Hastings with a proposal of your own, symmetric or not.

    A step costs one value of the log density, and two of the proposal's.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    proposal : Proposal
        The move.

    Raises
    ------
    TypeError
        If an argument is not as above.

    References
    ----------
    .. [1] W. K. Hastings, "Monte Carlo sampling methods using Markov chains and their applications", Biometrika 57(1),
       97-109 (1970).

    Examples
    --------
    A gamma distribution of shape 3 by multiplication with random factors:

    >>> import numpy as np
    >>> from evenlight.mcmc import MetropolisHastings, Proposal, run
    >>> factor = Proposal(1, lambda x, u: x * 9 ** (u - 0.5), lambda y, x: -np.log(y[:, 0]))
    >>> kernel = MetropolisHastings(lambda x: 2 * np.log(x[:, 0]) - x[:, 0], factor)
    >>> estimate = run(kernel, [3.0], n=2000, chains=16, burn_in=50, seed=1).estimate(lambda x: x[:, 0])
    >>> abs(estimate.value - 3) < 4 * estimate.standard_error < 0.2
    True
    """

    name: ClassVar[str] = "metropolis_hastings"

    log_density: LogDensity
    proposal: Proposal

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        if not isinstance(self.proposal, Proposal):
            raise TypeError(f"proposal must be a Proposal, not {type(self.proposal).__name__}")

    def dims(self, d: int) -> int:
        """Those of the proposal, and one for the acceptance."""
        del d
        return self.proposal.uniforms + 1

    def init(self, position: Any) -> DensityState:
        """Return positions and the target there."""
        return density_state(self.log_density, position)

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, Info]:
        """Propose; accept with the ratio of Hastings."""
        x = state.position
        proposal = np.asarray(self.proposal.draw(x, uniforms[:, :-1]), np.float64)
        if proposal.shape != x.shape:
            raise ValueError(f"draw must return positions of shape {x.shape}, not {proposal.shape}")
        log_density = evaluate(self.log_density, proposal)
        log_ratio = log_density - state.log_density + self._log_ratio(proposal, x)
        accepted, probability = metropolis(log_ratio, uniforms[:, -1])
        return moved(state, accepted, position=proposal, log_density=log_density), Info(probability, accepted)

    def _log_ratio(self, y: Array, x: Array) -> Any:
        """How much likelier the way back is."""
        if self.proposal.log_density is None:
            return 0.0
        back, forth = evaluate_proposal(self.proposal, x, y), evaluate_proposal(self.proposal, y, x)
        return back - forth


def evaluate_proposal(proposal: Proposal, y: Array, x: Array) -> Array:
    """The log density of proposing y from x; NaN is an error that names both."""
    assert proposal.log_density is not None
    values = np.asarray(proposal.log_density(y, x), np.float64)
    if values.shape != (len(x),):
        raise ValueError(f"the proposal's log_density must return the shape ({len(x)},), not {values.shape}")
    if np.isnan(values).any():
        row = int(np.isnan(values).argmax())
        raise ValueError(f"the proposal's log_density is NaN from {x[row].tolist()} to {y[row].tolist()}")
    return values
