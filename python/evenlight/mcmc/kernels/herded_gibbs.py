"""Herded Gibbs: deterministic Gibbs sampling of binary variables, with errors of order 1/T. For few variables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from evenlight.arguments import check_callable
from evenlight.mcmc.kernel import Array, Info, Kernel, State
from evenlight.mcmc.target import positions

__all__ = ["HerdedGibbs", "HerdedState"]

_MOST_VARIABLES = 16


@dataclass(frozen=True, eq=False)
class HerdedState(State):
    """Binary positions, and what each conditional probability still owes."""

    weights: Array
    """Shape (chains, d, 2^d): by variable and by the other variables' values."""


@dataclass(frozen=True, eq=False)
class HerdedGibbs(Kernel):
    """Gibbs sampling in which every conditional distribution is herded: it takes no random numbers.

    For each variable and each configuration of the others, a running sum of its conditional probability decides: 1 when
    the sum passes 1. On fully connected models the frequencies of all configurations converge as 1/T [1]_; on sparser
    ones a limit may be wrong, which is why the others' configuration is always kept as a whole. All chains of the same
    start are the same chain, so that estimates have no standard error.

    Parameters
    ----------
    conditional : callable
        ``conditional(x, j)``: from positions (m, d) of zeros and ones, the probabilities, shape (m,), that coordinate j
        is 1 given the others.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above, or there are more than 16 variables (memory: 8 d 2^d bytes a chain).

    References
    ----------
    .. [1] L. Bornn, Y. Chen, N. de Freitas, M. Eskelin, J. Fang and M. Welling, "Herded Gibbs sampling", International
       Conference on Learning Representations (2013).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import HerdedGibbs, run
    >>> kernel = HerdedGibbs(lambda x, j: 0.3 + 0.4 * x[:, 1 - j])  # both are 1 with probability 1/2
    >>> chains = run(kernel, [0, 0], n=1000, chains=1)
    >>> bool(abs(chains.draws[0].mean(axis=0) - 0.5).max() < 0.005)
    True
    """

    name: ClassVar[str] = "herded_gibbs"
    random: ClassVar[bool] = False

    conditional: Callable[[Any, int], Any]

    def __post_init__(self) -> None:
        check_callable("conditional", self.conditional)

    def dims(self, d: int) -> int:
        """None: it is deterministic."""
        if d > _MOST_VARIABLES:
            raise ValueError(f"herded Gibbs takes at most {_MOST_VARIABLES} variables, not {d}")
        return 0

    def init(self, position: Any) -> HerdedState:
        """Return the positions, with nothing owed."""
        x = positions(position)
        if not np.isin(x, (0.0, 1.0)).all():
            raise ValueError("positions must be zeros and ones")
        return HerdedState(x, np.zeros((*x.shape, 2 ** x.shape[1])))

    def step(self, state: HerdedState, uniforms: Array) -> tuple[HerdedState, Info]:
        """Update all variables, the first one first."""
        del uniforms
        x, weights = state.position.copy(), state.weights.copy()
        chains, d = x.shape
        rows, places = np.arange(chains), 2 ** np.arange(d)
        for j in range(d):
            probability = np.asarray(self.conditional(x, j), np.float64)
            if probability.shape != (chains,) or not ((probability >= 0) & (probability <= 1)).all():
                raise ValueError(f"conditional must return {chains} probabilities, not {probability}")
            others = (x @ places - x[:, j] * places[j]).astype(np.int64)
            owed = weights[rows, j, others] + probability
            x[:, j] = owed >= 1
            weights[rows, j, others] = owed - x[:, j]
        return HerdedState(x, weights), Info(np.ones(chains), np.ones(chains, bool))
