"""How wrong images are, against references that are a little wrong themselves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from evenlight import Film

__all__ = ["Reference", "coverage", "mean_squares"]

Image = NDArray[np.floating]
ROUNDING = 1e-6  # relative: pixels that see a light directly have no error but that of single precision


@dataclass(frozen=True)
class Reference:
    """An image (H, W, C) with the standard errors of its pixels, from so many independent batches."""

    mean: Image
    error: Image
    batches: int

    @classmethod
    def from_replicates(cls, replicates: Image) -> Reference:
        """The reference that replicates (R, H, W, C) make."""
        error = replicates.std(axis=0, ddof=1, dtype=np.float64) / np.sqrt(len(replicates))
        return cls(replicates.mean(axis=0, dtype=np.float64), error, len(replicates))


def mean_squares(images: Image, ours: Reference, theirs: Reference) -> dict[str, Any]:
    """Mean squared error of images (K, H, W, C) against both references, each reference's own variance taken off.

    E (x - r)^2 = E (x - truth)^2 + Var r when x and r are independent and unbiased.
    """
    result: dict[str, Any] = {}
    for name, reference in (("ours", ours), ("theirs", theirs)):
        squares = np.square(images - reference.mean).mean(axis=(1, 2, 3), dtype=np.float64)
        own = float(np.square(reference.error, dtype=np.float64).mean())
        result[name] = float(squares.mean()) - own
        result[f"{name}_error"] = float(squares.std(ddof=1) / np.sqrt(len(squares)))
    return result


def coverage(stacks: Image, ours: Reference, theirs: Reference) -> dict[str, Any]:
    """How often 95 % intervals of replicates (K, R, H, W, C) hold the reference.

    The intervals are those of `Film.confidence_interval`, and for comparison Student's t ("plain"). The reference's own
    error is allowed for: plain intervals are those of the difference of two independent means, with the degrees of
    freedom of Welch and Satterthwaite, and the film's are widened in the same proportion.
    """
    result: dict[str, Any] = {}
    for name, reference in (("ours", ours), ("theirs", theirs)):
        rates = np.array([_covered(stack, reference) for stack in stacks])
        result[name], result[f"{name}_plain"] = (float(rate) for rate in rates.mean(axis=0))
        result[f"{name}_lowest"], result[f"{name}_highest"] = float(rates[:, 0].min()), float(rates[:, 0].max())
    return result


def _covered(replicates: Image, reference: Reference) -> tuple[float, float]:
    """The shares of pixels and channels in the interval that a film offers and in that of Student."""
    count = len(replicates)
    variance = replicates.var(axis=0, ddof=1, dtype=np.float64) / count
    other = np.square(reference.error, dtype=np.float64)
    total = variance + other
    with np.errstate(invalid="ignore", divide="ignore"):
        freedom = np.nan_to_num(total**2 / (variance**2 / (count - 1) + other**2 / (reference.batches - 1)), nan=1.0)
        half = stats.t.ppf(0.975, freedom) * np.sqrt(total)
        # how much wider the film's interval must be to be that of the difference
        widening = half / (stats.t.ppf(0.975, count - 1) * np.sqrt(variance))
        low, high = (widening * end for end in _interval(replicates))
    low, high = (np.where(variance > 0, end, sign * half) for end, sign in ((low, -1), (high, 1)))
    difference = reference.mean - replicates.mean(axis=0, dtype=np.float64)
    exact = np.abs(difference) <= ROUNDING * np.abs(reference.mean)
    offered = exact | ((low <= difference) & (difference <= high))
    return float(offered.mean()), float((exact | (np.abs(difference) <= half)).mean())


def _interval(replicates: Image) -> tuple[Image, Image]:
    """The ends of a film's 95 % intervals, as differences from its color."""
    blank = np.zeros(replicates.shape[1:], np.float32)
    film = Film(replicates, albedo=blank, normal=blank, depth=blank[..., 0])
    low, high = film.confidence_interval(0.95)
    return low - film.color, high - film.color
