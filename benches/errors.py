"""How wrong images are, against references that are a little wrong themselves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import stats

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
    """How often Student-t 95 % intervals of replicates (K, R, H, W, C) hold the reference.

    The reference's own error is allowed for: the interval is that of the difference of two independent means, with the
    degrees of freedom of Welch and Satterthwaite.
    """
    result: dict[str, Any] = {}
    for name, reference in (("ours", ours), ("theirs", theirs)):
        rates = [_covered(stack, reference) for stack in stacks]
        result[name] = float(np.mean(rates))
        result[f"{name}_lowest"], result[f"{name}_highest"] = float(min(rates)), float(max(rates))
    return result


def _covered(replicates: Image, reference: Reference) -> float:
    count = len(replicates)
    variance = replicates.var(axis=0, ddof=1, dtype=np.float64) / count
    other = np.square(reference.error, dtype=np.float64)
    total = variance + other
    with np.errstate(invalid="ignore", divide="ignore"):
        freedom = total**2 / (variance**2 / (count - 1) + other**2 / (reference.batches - 1))
    quantile = stats.t.ppf(0.975, np.nan_to_num(freedom, nan=count - 1.0))
    distance = np.abs(replicates.mean(axis=0, dtype=np.float64) - reference.mean)
    return float((distance <= quantile * np.sqrt(total) + ROUNDING * np.abs(reference.mean)).mean())
