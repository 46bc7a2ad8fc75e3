"""The four panels by which multilevel runs are judged since Giles (2015), as a figure (which needs matplotlib)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.estimate import Estimate
from evenlight.figures import empty_figure
from evenlight.multilevel.level import LevelRow

__all__ = ["level_figure"]

Array = NDArray[np.float64]


def level_figure(estimate: Estimate) -> Any:
    """Variances, means, samples and checks against the level.

    Parameters
    ----------
    estimate : Estimate
        From `mlmc` or `mlqmc`; of several quantities the first is shown.

    Returns
    -------
    matplotlib.figure.Figure
        To be saved with `savefig`. Panels: log2 of the variances of P_l and of the differences; log2 of their
        absolute means; samples; kurtosis and consistency, the latter with its limit 1.

    Raises
    ------
    ImportError
        If matplotlib is not installed; `level_table` says the same in text.
    ValueError
        If the estimate has no levels, or pairs of levels.

    Examples
    --------
    >>> from evenlight.multilevel import level_figure, mlmc
    >>> from evenlight.multilevel.models import GeometricBrownianMotion
    >>> figure = level_figure(mlmc(GeometricBrownianMotion("european"), rmse=0.2, seed=1))
    >>> [panel.get_ylabel() for panel in figure.axes]
    ['log2 variance', 'log2 |mean|', 'samples', 'kurtosis', 'consistency']
    """
    rows = estimate.diagnostics.get("levels", ())
    if not rows or not isinstance(rows[0].level, int):
        raise ValueError(f"an estimate by {estimate.method!r} has no levels in a row to draw")
    figure = empty_figure(9, 7)
    panels = figure.subplots(2, 2).ravel()
    levels = [row.level for row in rows]
    for panel, name in zip(panels, ("variance", "mean"), strict=False):
        label = "log2 |mean|" if name == "mean" else "log2 variance"
        panel.plot(levels, _log2(_column(rows, f"fine_{name}")), "--*", label="P_l")
        panel.plot(levels[1:], _log2(_column(rows, name))[1:], "-*", label="P_l - P_(l-1)")
        panel.set(xlabel="level", ylabel=label)
        panel.legend()
    panels[2].semilogy(levels, [row.n for row in rows], "-o")
    panels[2].set(xlabel="level", ylabel="samples")
    panels[3].plot(levels[1:], _column(rows, "kurtosis")[1:], "-o", color="C2")
    panels[3].set_xlabel("level")
    panels[3].set_ylabel("kurtosis", color="C2")
    checks = panels[3].twinx()
    checks.plot(levels[1:], _column(rows, "consistency")[1:], "-s", color="C3")
    checks.axhline(1.0, linestyle=":", color="C3")
    checks.set_ylabel("consistency", color="C3")
    return figure


def _column(rows: tuple[LevelRow, ...], name: str) -> Array:
    return np.array([np.ravel(getattr(row, name))[0] for row in rows], np.float64)


def _log2(values: Array) -> Array:
    """NaN, which is not drawn, where there is nothing to take a logarithm of."""
    with np.errstate(divide="ignore"):
        logarithms = np.log2(np.abs(values))
    return np.where(np.isfinite(logarithms), logarithms, np.nan)
