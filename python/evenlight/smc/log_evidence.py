"""Estimates of the logarithm of a normalizing constant Z, whose replicates are unbiased for Z itself."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.estimate import Estimate
from evenlight.smc.weights import log_mean_exp

__all__ = ["LogEvidence", "log_evidence"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class LogEvidence(Estimate):
    """An estimate of log Z from independent replicates of Z.

    What a particle filter is unbiased for is Z, not its logarithm. So replicates are averaged as numbers, not as
    logarithms: `value` is the logarithm of their mean, and what merges is their mean. The standard error is that of the
    logarithm of a mean by the jackknife, and the value still has a bias of about -standard_error² / 2; both mean
    something while the error is well below 1.

    Attributes
    ----------
    diagnostics : dict
        "replicates", the logarithm of each replicate's Z, and what the method adds; all attributes are those of
        `Estimate`.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import smc
    >>> model = smc.StochasticVolatility()
    >>> one, other = (smc.filter(model, [0.5, -0.1], particles=256, seed=seed) for seed in (1, 2))
    >>> both = one.merge(other)
    >>> both.replicates, bool(np.isclose(2 * np.exp(both.value), np.exp(one.value) + np.exp(other.value)))
    (16, True)
    """

    def merge(self, other: Estimate) -> LogEvidence:
        """Combine with an independent estimate of the same Z with as many particles.

        Parameters
        ----------
        other : LogEvidence
            Of another seed.

        Returns
        -------
        LogEvidence
            Of all replicates together; other diagnostics are dropped.

        Raises
        ------
        ValueError
            If the other one is none, has another number of particles or steps, or comes from the same numbers.
        """
        if not isinstance(other, LogEvidence):
            raise ValueError(f"the logarithm of a mean merges with another one, not with {other.method!r}")
        if not math.isclose(self.n / self.replicates, other.n / other.replicates):
            raise ValueError("replicates merge if they have the same number of particles and steps")
        sources = self.diagnostics["points"] + other.diagnostics["points"]
        if len(set(sources)) < len(sources):
            raise ValueError("both estimates come from the same numbers; repeat with another seed")
        methods = dict.fromkeys([*self.method.split("+"), *other.method.split("+")])
        replicates = np.concatenate([self.diagnostics["replicates"], other.diagnostics["replicates"]])
        return log_evidence(
            replicates, n=self.n + other.n, cost=self.cost + other.cost, method="+".join(methods), points=sources
        )


def log_evidence(
    logarithms: Any, *, n: int, cost: float, method: str, points: tuple[str, ...], **diagnostics: Any
) -> LogEvidence:
    """The estimate from the logarithm of each independent replicate; NaN is the error of a single one."""
    values = np.asarray(logarithms, np.float64)
    count = len(values)
    error = math.nan
    if count > 1:
        without = np.array([log_mean_exp(np.delete(values, i)) for i in range(count)])
        error = float(np.sqrt((count - 1) / count * ((without - without.mean()) ** 2).sum()))
    return LogEvidence(
        value=log_mean_exp(values),
        standard_error=error,
        n=n,
        replicates=count,
        cost=cost,
        method=method,
        degrees_of_freedom=count - 1 if count > 1 else math.nan,
        diagnostics={"replicates": values, "points": points, **diagnostics},
    )
