"""Primary sample space Metropolis: small and large steps in the unit cube. For integrands of uniform numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import check_callable
from evenlight.mcmc.kernel import Array, Info, Kernel, LogDensity, metropolis
from evenlight.mcmc.target import DensityState, density_state, evaluate, moved

__all__ = ["PrimarySampleInfo", "PrimarySampleSpace"]


@dataclass(frozen=True, eq=False)
class PrimarySampleInfo(Info):
    """What a step has to tell: with the draws, all that estimates from accepted and rejected proposals need."""

    large: NDArray[np.bool_]
    """Whether the step was a large one."""
    proposal: Array
    """Where it went, shape (chains, d)."""
    proposal_log_density: Array
    """The target there."""
    log_density: Array
    """The target where the chain is after the step."""


@dataclass(frozen=True, eq=False)
class PrimarySampleSpace(Kernel):
    """Metropolis in the unit cube [1]_: a fresh uniform point now and then, small steps of all coordinates otherwise.

    A small step moves every coordinate by plus or minus `largest` (`smallest` / `largest`)^u, that is, by a size whose
    logarithm is uniform, and wraps around the cube's edge. A step costs one value of the log density. This is the
    mutation of Metropolis light transport, where the coordinates are the numbers that drive a light path;
    `expected_value_integral` makes integrals of the run.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) in [0, 1)^d to logarithms of the unnormalized target (m,).
    large_step : float
        The probability of a large step, above 0 and at most 1; 0.3 to 0.5 are usual.
    smallest, largest : float
        Sizes of small steps, above 0 and at most 1/2. Their mean is (largest - smallest) / log(largest / smallest).

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] C. Kelemen, L. Szirmay-Kalos, G. Antal and F. Csonka, "A simple and robust mutation strategy for the
       Metropolis light transport algorithm", Comput. Graph. Forum 21(3), 531-540 (2002).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import PrimarySampleSpace, run
    >>> kernel = PrimarySampleSpace(lambda u: -20 * abs(u[:, 0] - 0.3))
    >>> chains = run(kernel, [0.5, 0.5], n=2000, chains=16, burn_in=100, seed=1)
    >>> estimate = chains.estimate(lambda u: u[:, 0] < 0.3)
    >>> abs(estimate.value - 0.5) < 4 * estimate.standard_error < 0.1
    True
    """

    name: ClassVar[str] = "primary_sample_space"

    log_density: LogDensity
    large_step: float = 0.3
    smallest: float = 1 / 1024
    largest: float = 1 / 64

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        if not 0 < self.large_step <= 1:
            raise ValueError(f"large_step must be above 0 and at most 1, not {self.large_step}")
        if not 0 < self.smallest <= self.largest <= 0.5:
            raise ValueError(
                f"smallest and largest must satisfy 0 < smallest <= largest <= 1/2, not {self.smallest}, {self.largest}"
            )

    def dims(self, d: int) -> int:
        """One for each coordinate, one for the kind of step, one for the acceptance."""
        return d + 2

    def init(self, position: Any) -> DensityState:
        """Return positions in the cube and the target there."""
        state = density_state(self.log_density, position)
        outside = ((state.position < 0) | (state.position >= 1)).any(axis=1)
        if outside.any():
            chain = int(np.argmax(outside))
            raise ValueError(f"chain {chain} starts at {state.position[chain].tolist()}, outside of [0, 1)^d")
        return state

    def step(self, state: DensityState, uniforms: Array) -> tuple[DensityState, PrimarySampleInfo]:
        """Propose a large or a small step; accept or stay. Both are symmetric."""
        x, u = state.position, uniforms[:, :-2]
        large = uniforms[:, -2] < self.large_step
        proposal = np.where(large[:, None], u, self._small_steps(x, u))
        log_density = evaluate(self.log_density, proposal)
        accepted, probability = metropolis(log_density - state.log_density, uniforms[:, -1])
        after = moved(state, accepted, position=proposal, log_density=log_density)
        return after, PrimarySampleInfo(probability, accepted, large, proposal, log_density, after.log_density)

    def _small_steps(self, x: Array, u: Array) -> Array:
        """The lower half of each uniform number steps down, the upper half up."""
        size = self.largest * (self.smallest / self.largest) ** np.abs(2 * u - 1)
        moved_by = x + np.where(u < 0.5, -size, size)
        wrapped = moved_by - np.floor(moved_by)
        return np.asarray(np.where(wrapped < 1, wrapped, 0.0))  # what is just below 0 would round to 1
