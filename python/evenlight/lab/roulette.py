"""Russian roulette as a de-biased sum: survival probabilities from what bounces contribute and cost, and fixed ones.

A path without end is a sum of bounces whose expectation a renderer wants without bias and in finite time. Roulette that
does not look at the path is the coupled sum of Rhee and Glynn: a bounce that is reached with probability S_l counts
1 / S_l times.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import NamedTuple, SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.bounces import BounceStatistics, bounce_statistics
from evenlight.multilevel.level_distribution import best_for_sum
from evenlight.rendering import Scene, load_scene, render

__all__ = ["RouletteResult", "RouletteStudy", "optimal_survival", "roulette_study"]

Array = NDArray[np.float64]

_LUMINANCE = np.array([0.212671, 0.715160, 0.072169])  # of linear sRGB (ITU-R BT.709)
_LEAST, _MOST = 1e-3, 0.99  # of survival probabilities: paths must end, and what is never reached is lost
_RUNS = 8  # of a render, for the standard errors of variances


class RouletteResult(NamedTuple):
    """One sample of a pixel under one roulette: means over the pixels of an image, in luminance."""

    roulette: str | tuple[float, ...]
    """As `render` takes it."""
    mean: float
    """Of the image; the same for every roulette, within errors."""
    variance: float
    """Of one sample, as rendered; its standard error comes next."""
    standard_error: float
    predicted_variance: float
    """From the measured bounces; NaN for roulette that looks at the path."""
    rays: float
    """Expected rays per sample, from the measured bounces; NaN likewise."""
    seconds: float
    """Per sample, as rendered."""

    @property
    def work(self) -> float:
        """Predicted variance times rays: what the optimal probabilities minimize."""
        return self.predicted_variance * self.rays


class RouletteStudy(NamedTuple):
    """Optimal probabilities against others, and the bounces that they come from."""

    optimal: RouletteResult
    others: Mapping[str, RouletteResult]
    bounces: BounceStatistics


def optimal_survival(bounces: BounceStatistics, squared_mean: float = 0.0) -> tuple[float, ...]:
    """Survival probabilities of roulette that minimize variance times cost.

    Parameters
    ----------
    bounces : BounceStatistics
        Contributions and costs of D + 1 segments, as measured; the last one only says what lies beyond.
    squared_mean : float
        The mean over the pixels of their squared luminance, at least 0: the part of the second moment that is no
        variance. With 0, the second moment times cost is minimized, which asks for somewhat longer paths.

    Returns
    -------
    tuple of float
        For `render(roulette=…)`: D probabilities, each from 0.001 to 0.99.

    Raises
    ------
    ValueError
        If there are fewer than 2 segments, or the squared mean is not below the second moment.

    Notes
    -----
    With T_l the sum of the contributions from segment l on, ν_l = E T_l² - E T_(l+1)², less the squared mean for the
    first, variance and cost are Σ ν_l / S_l and Σ t_l S_l. Segments are pooled where S_l ∝ √(ν_l / t_l) would increase.

    References: C.-H. Rhee and P. W. Glynn, "Unbiased estimation with square root convergence for SDE models", Oper.
    Res. 63(5), 1026-1043 (2015), section 3.

    Examples
    --------
    Where the second moment of what is left falls by 4 from segment to segment, and all segments cost the same, half of
    the paths go on at each surface:

    >>> import numpy as np
    >>> from evenlight import BounceStatistics
    >>> from evenlight.lab import optimal_survival
    >>> falling = 0.25 ** np.arange(7)
    >>> bounces = BounceStatistics(falling, falling, falling, np.ones(7), np.ones(7))
    >>> [round(p, 2) for p in optimal_survival(bounces)]
    [0.5, 0.5, 0.5, 0.5, 0.5, 0.5]
    """
    if len(bounces.rays) < 2:
        raise ValueError(f"bounces must have at least 2 segments, not {len(bounces.rays)}")
    if not 0 <= squared_mean < bounces.tail_mean_square[0]:
        limit = bounces.tail_mean_square[0]
        raise ValueError(
            f"squared_mean must be at least 0 and below the second moment, {limit:.6g}, not {squared_mean}"
        )
    terms, costs = _terms(bounces, squared_mean), bounces.rays[:-1]
    reach = best_for_sum(terms, costs, 0.0).survival(np.arange(len(terms) + 1))
    reach[-1] = reach[-2] * reach[-2] / reach[-3] if len(terms) > 1 else 0.5
    return tuple(np.clip(reach[1:] / reach[:-1], _LEAST, _MOST).tolist())


def roulette_study(
    scene: Scene | str | os.PathLike[str],
    *,
    segments: SupportsIndex = 16,
    spp: SupportsIndex = 64,
    size: tuple[int, int] = (64, 64),
    fixed: Sequence[float] = (0.5, 0.75, 0.9),
    seed: int = 0,
) -> RouletteStudy:
    """Render a scene with optimal survival probabilities, with fixed ones, and with roulette by throughput.

    Paths have no greatest length: every result is without bias.

    Parameters
    ----------
    scene : Scene or path
        What to render.
    segments : int
        Of the paths that are measured, at least 3; further bounces take the last probability.
    spp : int
        Independent samples per pixel of each of 8 renders, and of the measured paths, at least 2.
    size : (int, int)
        Width and height in pixels.
    fixed : sequence of float
        Constant survival probabilities, below 1, to compare with.
    seed : int
        The same seed gives the same variances, to the bit.

    Returns
    -------
    RouletteStudy
        `others` has the fixed probabilities by their number, and "throughput".

    Raises
    ------
    ValueError
        If a number is out of its range; the message names it.

    Notes
    -----
    Memory: 12 spp bytes per pixel. What the prediction leaves out is what lies beyond the measured segments.

    Examples
    --------
    >>> from evenlight.lab import roulette_study
    >>> study = roulette_study("scenes/box.xml", spp=16, size=(16, 16), fixed=[0.5])
    >>> study.optimal.work <= study.others["0.5"].work
    True
    """
    depth, count = integer("segments", segments, 3), integer("spp", spp, 2)
    if not all(0 < p < 1 for p in fixed):
        raise ValueError(f"fixed must be probabilities above 0 and below 1, not {list(fixed)}")
    loaded = scene if isinstance(scene, Scene) else load_scene(scene)
    bounces = bounce_statistics(
        loaded, count, seed, depth + 1, sampler="independent", size=size, filter="box", images=True
    )
    squared_mean = _squared_mean(bounces, count)

    def result(roulette: str | tuple[float, ...]) -> RouletteResult:
        return _render(loaded, roulette, (count, size, seed), bounces, squared_mean)

    others = {f"{p:g}": result((float(p),)) for p in fixed} | {"throughput": result("throughput")}
    return RouletteStudy(result(optimal_survival(bounces, squared_mean)), others, bounces)


def _terms(bounces: BounceStatistics, squared_mean: float) -> Array:
    """ν_l of all segments but the last, which stands for what lies beyond."""
    terms = -np.diff(bounces.tail_mean_square)
    terms[0] -= squared_mean
    return terms


def _squared_mean(bounces: BounceStatistics, spp: int) -> float:
    """The mean square of the pixels' means, less what the noise of `spp` independent samples adds."""
    assert bounces.images is not None
    squares = float(np.mean((bounces.images.sum(axis=0) @ _LUMINANCE) ** 2))
    return max(0.0, (spp * squares - float(bounces.tail_mean_square[0])) / (spp - 1))


def _render(
    scene: Scene,
    roulette: str | tuple[float, ...],
    settings: tuple[int, tuple[int, int], int],
    bounces: BounceStatistics,
    squared_mean: float,
) -> RouletteResult:
    spp, size, seed = settings
    films = [
        render(
            scene,
            sampler="independent",
            spp=spp,
            replicates=spp,
            seed=seed + 1 + run,
            max_depth=-1,
            size=size,
            filter="box",
            roulette=roulette,
        )
        for run in range(_RUNS)
    ]
    samples = np.array([film.replicates.astype(np.float64) @ _LUMINANCE for film in films])
    variances = samples.var(axis=1, ddof=1).mean(axis=(1, 2))
    predicted, rays = (np.nan, np.nan) if isinstance(roulette, str) else _predict(roulette, bounces, squared_mean)
    return RouletteResult(
        roulette,
        float(samples.mean()),
        float(variances.mean()),
        float(variances.std(ddof=1) / np.sqrt(_RUNS)),
        predicted,
        rays,
        sum(film.metadata["seconds"] for film in films) / samples.size,
    )


def _predict(survival: Sequence[float], bounces: BounceStatistics, squared_mean: float) -> tuple[float, float]:
    """Variance and rays of a sample, from the measured segments."""
    terms = np.append(_terms(bounces, squared_mean), bounces.tail_mean_square[-1])
    further = np.full(max(0, len(terms) - 1 - len(survival)), survival[-1])
    reach = np.cumprod(np.concatenate([[1.0], survival[: len(terms) - 1], further]))
    return float(np.sum(terms / reach)), float(np.sum(reach * bounces.rays))
