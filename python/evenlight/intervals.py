"""Confidence intervals from a mean and its standard error: Student's t, with the skewness taken out if it is known."""

from __future__ import annotations

from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import special

__all__ = ["Interval", "bounds", "check_level", "degrees_of_sum", "skewness", "student_quantile"]

T = TypeVar("T")


class Interval(NamedTuple, Generic[T]):
    """A confidence interval, of a number or of every entry of an array."""

    low: T
    """The lower end, or ends."""
    high: T
    """The upper end, or ends."""


def check_level(level: float) -> float:
    """Return the level, or raise a ValueError if it is not between 0 and 1."""
    if not 0.0 < level < 1.0:
        raise ValueError(f"level must be between 0 and 1, not {level}")
    return float(level)


def student_quantile(level: float, degrees: Any) -> Any:
    """The half width of a two-sided interval of Student's t, in standard errors."""
    return special.stdtrit(degrees, 0.5 + 0.5 * level)


def degrees_of_sum(variances: Any, degrees: Any) -> float:
    """Welch and Satterthwaite's degrees of freedom of a sum of independent means; of several quantities the least.

    `variances` are those of the means, shape (means, ...), with `degrees`, shape (means,); all degrees together where
    nothing varies.
    """
    variances, degrees = np.asarray(variances, np.float64), np.asarray(degrees, np.float64)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = variances.sum(axis=0) ** 2 / (variances**2 / degrees.reshape(-1, *[1] * (variances.ndim - 1))).sum(
            axis=0
        )
    return float(np.min(np.where(np.isfinite(ratio), ratio, degrees.sum())))


def bounds(value: Any, standard_error: Any, quantile: Any, skew: Any = 0.0) -> tuple[Any, Any]:
    """Ends of the interval of a mean whose own skewness is `skew`.

    The skewness is taken out by a monotone cubic transformation of the t statistic (P. Hall, "On the removal of
    skewness by transformation", J. R. Stat. Soc. B 54(1), 221-228, 1992); 0 gives the symmetric interval.
    """
    return value - standard_error * _unskewed(quantile, skew), value - standard_error * _unskewed(-quantile, skew)


def skewness(second: Any, third: Any) -> NDArray[np.float64]:
    """Third central moment over the 3/2 power of the second; 0 where nothing varies."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(np.where(second > 0, third / second**1.5, 0.0))


def _unskewed(t: Any, skew: Any) -> NDArray[np.float64]:
    """The T with ``T + s (T^2 / 3 + 1 / 6) + s^2 T^3 / 27 = t``, s the skewness of the mean (Hall 1992)."""
    with np.errstate(invalid="ignore", divide="ignore"):
        root = 3 * (np.cbrt(1 + skew * (t - skew / 6)) - 1) / skew
    return np.asarray(np.where(np.abs(skew) > 1e-6, root, t))
