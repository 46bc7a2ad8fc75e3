"""From levels to an estimate: the sum over levels, its error, and what the table of levels warns of."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np

from evenlight.estimate import Estimate, NotConvergedWarning
from evenlight.multilevel.decay import Rates
from evenlight.multilevel.level import LevelRow, plain

__all__ = ["MultilevelWarning", "level_table", "sum_of_levels", "warn"]

_HIGH_KURTOSIS = 100.0


class MultilevelWarning(UserWarning):
    """Levels do not fit together, or are hardly known.

    Examples
    --------
    >>> import warnings
    >>> from evenlight.multilevel import MultilevelWarning
    >>> warnings.simplefilter("error", MultilevelWarning)  # let doubtful runs fail
    """


def sum_of_levels(rows: Sequence[LevelRow], rates: Rates | tuple[Rates, Rates], bias: Any, **rest: Any) -> Estimate:
    """The estimate whose value is the sum of the levels' means; `rest` are other attributes of `Estimate`."""
    variances = [np.asarray(row.variance) / row.n for row in rows]
    variance = sum(variances)
    diagnostics = {"levels": tuple(rows), "rates": rates, "bias": bias, "variance": plain(variance)}
    return Estimate(
        value=plain(sum(np.asarray(row.mean) for row in rows)),
        standard_error=plain(np.sqrt(variance)),
        n=sum(row.n for row in rows),
        bias=plain(bias),
        diagnostics=diagnostics | {"warnings": _doubts(rows)} | rest.pop("diagnostics", {}),
        **rest,
    )


def warn(estimate: Estimate, stacklevel: int = 3) -> Estimate:
    """Say what is doubtful about an estimate, and give it back."""
    for text in estimate.diagnostics["warnings"]:
        warnings.warn(text, MultilevelWarning, stacklevel=stacklevel)
    if not estimate.converged:
        warnings.warn(f"{estimate.message}: {estimate!r}", NotConvergedWarning, stacklevel=stacklevel)
    return estimate


def level_table(estimate: Estimate) -> str:
    """The levels of a multilevel estimate as a table of text.

    Parameters
    ----------
    estimate : Estimate
        From `mlmc`, `mlqmc` or `multi_index`.

    Returns
    -------
    str
        A line for each level: samples, mean and variance of the difference, cost per sample, kurtosis, consistency; of
        several quantities the first.

    Raises
    ------
    ValueError
        If the estimate has no levels.

    Examples
    --------
    >>> from evenlight.multilevel import FunctionSampler, level_table, mlmc
    >>> series = FunctionSampler(lambda level, u: (u[:, 0] * (2 - 0.5**level), u[:, 0] * (2 - 0.5 ** (level - 1))))
    >>> print(level_table(mlmc(series, rmse=0.01, seed=1)).splitlines()[0])
    level         N        mean    variance        cost    kurtosis consistency
    """
    if "levels" not in estimate.diagnostics:
        raise ValueError(f"an estimate by {estimate.method!r} has no levels")
    names = ("mean", "variance", "cost", "kurtosis", "consistency")
    lines = [f"{'level':<6}{'N':>9}" + "".join(f"{name:>12}" for name in names)]
    for row in estimate.diagnostics["levels"]:
        numbers = [float(np.ravel(getattr(row, name))[0]) for name in names]
        lines.append(f"{row.level!s:<6}{row.n:>9}" + "".join(f"{number:>12.4g}" for number in numbers))
    return "\n".join(lines)


def _doubts(rows: Sequence[LevelRow]) -> tuple[str, ...]:
    found = []
    for row in rows:
        if np.nanmax(np.append(row.consistency, 0.0)) > 1.0:
            found.append(
                f"level {row.level}: the coarse values do not have the mean of the fine ones one level below "
                f"(consistency {np.nanmax(row.consistency):.2g} > 1); the estimate is biased"
            )
        if np.nanmax(np.append(row.kurtosis, 0.0)) > _HIGH_KURTOSIS:
            found.append(
                f"level {row.level}: kurtosis {np.nanmax(row.kurtosis):.0f} > {_HIGH_KURTOSIS:.0f}; "
                "its variance is hardly known"
            )
    return tuple(found)
