"""Two images that both carry errors, compared block by block in units of the combined standard error.

Blocks of 8 × 8 pixels are nearly normally distributed where pixels are not, and there are still hundreds of them, so
that their tail is worth counting: one bad mesh or one wrong normal shows as a cluster of blocks, noise does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["SIDE", "Comparison", "block_means", "compare", "pool"]

SIDE = 8
SIGMA = 4.0
FLOOR = 0.002  # of the block's and of the image's mean: what two right renderers may disagree about

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Comparison:
    """How far an image is from its reference.

    Attributes
    ----------
    beyond : float
        The fraction of (block, channel) further than 4 combined standard errors from the reference.
    difference, difference_error : float
        Relative difference of the image means, and its standard error.
    deviations : ndarray, shape (H // 8, W // 8, 3)
        Signed distance of every block in combined standard errors.
    """

    beyond: float
    difference: float
    difference_error: float
    deviations: Array


def pool(comparisons: Sequence[Comparison]) -> Comparison:
    """The mean of comparisons of independent renders with one reference: the same figures, less noisy.

    The error of the difference is not lowered, because the reference's share of it is common to all.
    """
    squares = [found.difference_error**2 for found in comparisons]
    return Comparison(
        beyond=float(np.mean([found.beyond for found in comparisons])),
        difference=float(np.mean([found.difference for found in comparisons])),
        difference_error=float(np.sqrt(np.mean(squares))),
        deviations=comparisons[0].deviations,
    )


def block_means(image: NDArray[np.floating], side: int = SIDE) -> Array:
    """Average (..., H, W, C) over squares; incomplete ones at the lower and right edge are left out."""
    *lead, height, width, channels = image.shape
    rows, columns = height // side, width // side
    whole = image[..., : rows * side, : columns * side, :]
    squares = whole.reshape(*lead, rows, side, columns, side, channels)
    means: Array = squares.mean(axis=(-4, -2), dtype=np.float64)
    return means


def compare(
    replicates: NDArray[np.floating], reference: NDArray[np.floating], reference_error: NDArray[np.floating]
) -> Comparison:
    """Compare an image of replicates (R, H, W, C) with a reference (H, W, C) and its standard errors.

    The error of a block of ours is the spread of its replicate means, which knows how pixels hang together; that of
    the reference takes its pixels as independent, which they are.
    """
    ours = block_means(replicates)
    error = ours.std(axis=0, ddof=1) / np.sqrt(len(ours))
    theirs = block_means(reference)
    their_error = np.sqrt(block_means(np.square(reference_error, dtype=np.float64))) / SIDE
    combined = np.hypot(error, their_error)
    sigma = np.maximum(combined, FLOOR * np.maximum(np.abs(theirs), np.abs(reference).mean()))
    deviations = (ours.mean(axis=0) - theirs) / sigma

    total = float(reference.mean(dtype=np.float64))
    means = replicates.mean(axis=(1, 2, 3), dtype=np.float64)
    mean_error = means.std(ddof=1) / np.sqrt(len(means))
    their_mean_error = np.sqrt(np.square(reference_error, dtype=np.float64).sum()) / reference.size
    return Comparison(
        # `not <=`, so that a NaN counts as beyond
        beyond=float((~(np.abs(deviations) <= SIGMA)).mean()),
        difference=float(means.mean() / total - 1),
        difference_error=float(np.hypot(mean_error, their_mean_error) / total),
        deviations=deviations,
    )
