"""What each bounce of light contributes to an image and costs: what a choice of survival probabilities needs.

Measure before a render with `roulette=[…]`: the numbers say how much the error would gain from letting paths live
longer, and what it would cost.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight import _core
from evenlight.rendering import Scene, check_ranges, load_scene

__all__ = ["BounceStatistics", "bounce_statistics"]


@dataclass(frozen=True)
class BounceStatistics:
    """Means over all paths of an image, in luminance; entry `l` is of the segment `l + 1` of a path.

    A path without roulette is a sum of contributions Δ₁ + Δ₂ + … over its segments: Δ_l is what it gathers at the end
    of segment l, the light that it ran into there and the light that was sampled from there.

    Attributes
    ----------
    mean : ndarray of float64, shape (max_depth,)
        Of the contribution, E Δ_l. They sum to the mean of the image.
    mean_square : ndarray of float64, shape (max_depth,)
        Of the squared contribution, E Δ_l².
    tail_mean_square : ndarray of float64, shape (max_depth,)
        Of the squared sum of this contribution and all further ones, E T_l² with T_l = Δ_l + Δ_{l+1} + …
    alive : ndarray of float64, shape (max_depth,)
        The share of the paths that have this segment; the first is 1. The others left the scene or were absorbed.
    rays : ndarray of float64, shape (max_depth,)
        The cost: rays per path of the image, those of the segment and those to lights that are sampled at its end.
    images : ndarray of float32, shape (max_depth, height, width, 3), or None
        The mean contribution to every pixel, in linear RGB, if they were asked for.

    Examples
    --------
    What samples cost, and their second moment, when half of the paths end at every surface:

    >>> import evenlight, numpy as np
    >>> measured = evenlight.bounce_statistics("scenes/furnace.xml", spp=256, size=(8, 8), max_depth=6)
    >>> reach = 0.5 ** np.arange(6)
    >>> second_moment = np.sum(-np.diff(measured.tail_mean_square, append=0) / reach)
    >>> bool(second_moment > measured.tail_mean_square[0])
    True
    >>> bool(np.sum(reach * measured.rays) < np.sum(measured.rays) / 2)
    True
    """

    mean: NDArray[np.float64]
    mean_square: NDArray[np.float64]
    tail_mean_square: NDArray[np.float64]
    alive: NDArray[np.float64]
    rays: NDArray[np.float64]
    images: NDArray[np.float32] | None = None


def bounce_statistics(  # every argument is one setting
    scene: Scene | str | os.PathLike[str],
    spp: int = 64,
    seed: int = 0,
    max_depth: int = 16,
    *,
    sampler: str = "sobol",
    size: tuple[int, int] | None = None,
    filter: str | None = None,
    mis: str = "power",
    threads: int | None = None,
    images: bool = False,
) -> BounceStatistics:
    """Measure what each bounce contributes and costs, with paths that never end by roulette.

    Parameters
    ----------
    scene : Scene or path
        What to measure. A path is read with `load_scene` first.
    spp : int
        Samples per pixel.
    seed : int
        In [0, 2**64). The same seed gives the same bits, whatever the number of threads.
    max_depth : int
        The longest path in segments, 1 to 1024. The last segment has no light that is sampled from its end, since
        that would be a segment more: ask for one segment more than you need.
    sampler, size, filter, mis, threads
        As for `render`.
    images : bool
        Whether to keep an image of each segment's contribution; at most 2**27 colors together.

    Returns
    -------
    BounceStatistics

    Raises
    ------
    ValueError
        If a setting is out of its range or unknown; the message says what is allowed.
    OSError
        If a file of the scene cannot be read.

    Notes
    -----
    Let roulette, independent of the path, allow segment l with probability S_l = s_1 s_2 ⋯ s_{l-1}, as `render` does
    with ``roulette=[s_1, s_2, …]``. Its samples are Σ Δ_l / S_l as far as they get. Their mean is that of the paths
    without roulette, their second moment Σ (E T_l² − E T_{l+1}²) / S_l, and their expected cost Σ S_l rays_l [1]_.
    The cost of measuring is that of a render without roulette.

    References
    ----------
    .. [1] C.-H. Rhee, P. W. Glynn, Unbiased estimation with square root convergence for SDE models, Operations
       Research 63 (2015).

    Examples
    --------
    In a furnace of reflectance 1/2 every bounce brings half of the one before.

    >>> import evenlight
    >>> measured = evenlight.bounce_statistics("scenes/furnace.xml", spp=256, size=(8, 8), max_depth=6)
    >>> (measured.mean[2:5] / measured.mean[1:4]).round(1).tolist()
    [0.5, 0.5, 0.5]
    >>> measured.alive.tolist()
    [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]
    """
    if not isinstance(scene, Scene):
        scene = load_scene(scene)
    settings: dict[str, Any] = {
        "integrator": "path",
        "sampler": sampler,
        "spp": spp,
        "replicates": 1,
        "seed": seed,
        "threads": threads,
        "max_depth": max_depth,
        "filter": filter,
        "size": size,
        "mis": mis,
        "roulette": "none",
    }
    check_ranges(settings)
    return BounceStatistics(**_core.measure_bounces(scene._core, settings, images))
