"""Estimates: a value, how far it may be from the truth, and what it took to get it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight import bootstrap, intervals
from evenlight.intervals import Interval
from evenlight.medians import Medians
from evenlight.moments import Moments
from evenlight.stopping import sequential_quantile

__all__ = ["Estimate", "NotConvergedWarning", "from_error", "from_moments", "plain"]

Array = NDArray[np.float64]
Summary = Moments | Medians


class NotConvergedWarning(UserWarning):
    """A run reached its limit before its tolerance."""


@dataclass(frozen=True, eq=False)
class Estimate:
    """An estimate of a number, or of an array of numbers, with its standard error.

    Attributes
    ----------
    value : float or ndarray
        The estimate.
    standard_error : float or ndarray
        Of `value`, and of its shape; NaN where nothing independent was repeated.
    n : int
        Function values behind `value`.
    replicates : int
        How many independent things the error is judged by: point sets, or for plain Monte Carlo the values themselves.
    cost : float
        Function values in all, those of pilot runs included.
    method : str
        What made it.
    converged : bool
        Whether the tolerance was reached; True if there was none. Of chains: whether they agree.
    message : str
        How it ended, in words.
    diagnostics : dict
        What the method has to say besides; see there.
    degrees_of_freedom : float
        Of `standard_error`.
    bias : float or ndarray
        A bound on what no repetition shows, such as the error of the finest discretization; intervals are wider by it.
    sequential : bool
        Whether the run stopped when its interval was short enough; intervals are then wider, to keep their promise.
    groups : tuple of (float, Moments or Medians)
        Function values per replicate, and what is known of the replicates: what makes estimates merge.

    Examples
    --------
    >>> import evenlight
    >>> from evenlight.points import Sobol
    >>> estimate = evenlight.integrate(lambda x: x.prod(axis=1), Sobol(2, seed=1), n=4096)
    >>> low, high = estimate.confidence_interval(0.99)
    >>> bool(low < 0.25 < high)
    True
    >>> other = evenlight.integrate(lambda x: x.prod(axis=1), Sobol(2, seed=2), n=4096)
    >>> estimate.merge(other).replicates
    32
    """

    value: Any
    standard_error: Any
    n: int
    replicates: int
    cost: float
    method: str
    converged: bool = True
    message: str = ""
    diagnostics: dict[str, Any] = field(default_factory=dict)
    degrees_of_freedom: float = math.nan
    bias: Any = 0.0
    sequential: bool = False
    groups: tuple[tuple[float, Summary], ...] = field(default=(), repr=False)

    def confidence_interval(self, level: float = 0.95, kind: str = "t") -> Interval[Any]:
        """Bounds that hold the truth in about `level` of the cases, for each entry of an array by itself.

        Parameters
        ----------
        level : float
            Above 0 and below 1.
        kind : {"t", "unskewed", "percentile-t"}
            "t": Student's t, the most dependable one for replicates of randomized point sets [1]_. "unskewed": with
            the skewness of the replicates taken out (Hall 1992), for few and skewed ones. "percentile-t": the
            bootstrap's quantiles of the t statistic (fixed seed, 2,000 resamples), for 8 replicates or more.

        Returns
        -------
        Interval
            `low` and `high`. NaN if there is no error estimate; from a deterministic bound, if there is one.

        Raises
        ------
        ValueError
            If the level or the kind is none of the above, or the replicates it asks for were not kept.

        References
        ----------
        .. [1] P. L'Ecuyer, M. K. Nakayama, A. B. Owen and B. Tuffin, "Confidence intervals for randomized quasi-Monte
           Carlo estimators", Winter Simulation Conference (2023).
        """
        intervals.check_level(level)
        if kind not in _KINDS:
            raise ValueError(f"unknown kind of interval {kind!r}; known: {', '.join(_KINDS)}")
        if "bound" in self.diagnostics:
            bound = self.diagnostics["bound"]
            return Interval(self.value - bound, self.value + bound)
        low, high = _KINDS[kind](self, level)
        return Interval(plain(low - self.bias), plain(high + self.bias))

    def half_width(self, level: float) -> Any:
        """Half the length of the interval of Student's t, widened if the run was `sequential`."""
        return self.standard_error * self._quantile(level)

    def merge(self, other: Estimate) -> Estimate:
        """Combine with an independent estimate of the same thing; the order of merging does not matter.

        Values count by their `n`. Replicates of the same size are pooled, as if they were of one run, so that medians
        become the median of all; otherwise the degrees of freedom follow Welch and Satterthwaite.

        Parameters
        ----------
        other : Estimate
            From other points: another seed, or other rows.

        Returns
        -------
        Estimate
            Of the total `n` and `cost`.

        Raises
        ------
        TypeError
            If `other` is no estimate.
        ValueError
            If the shapes differ, both come from the very same points, or there are no moments to merge.
        """
        if not isinstance(other, Estimate):
            raise TypeError(f"estimates merge with estimates, not with {type(other).__name__}")
        if np.shape(self.value) != np.shape(other.value):
            raise ValueError(f"values of shapes {np.shape(self.value)} and {np.shape(other.value)} do not merge")
        if not (self.groups and other.groups):
            raise ValueError(f"an estimate by {(other if self.groups else self).method!r} does not merge")
        sources = self.diagnostics.get("points", ()) + other.diagnostics.get("points", ())
        if len(set(sources)) < len(sources):
            raise ValueError("both estimates come from the same points; repeat with another seed")
        methods = dict.fromkeys([*self.method.split("+"), *other.method.split("+")])
        return from_moments(
            self.groups + other.groups,
            method="+".join(methods),
            cost=self.cost + other.cost,
            converged=self.converged and other.converged,
            message="; ".join(dict.fromkeys(filter(None, [self.message, other.message]))),
            diagnostics={"points": sources} if sources else {},
            bias=(self.n * self.bias + other.n * other.bias) / (self.n + other.n),
            sequential=self.sequential or other.sequential,
        )

    def to_dict(self) -> dict[str, Any]:
        """All of it in plain values, as JSON has them, without the moments.

        Returns
        -------
        dict
            By the names of the attributes.
        """
        names = ("value", "standard_error", "n", "replicates", "cost", "method", "converged", "message")
        plain = {name: _json(getattr(self, name)) for name in names}
        degrees = None if math.isnan(self.degrees_of_freedom) else self.degrees_of_freedom
        return plain | {
            "degrees_of_freedom": degrees,
            "bias": _json(self.bias),
            "sequential": self.sequential,
            "diagnostics": _json(self.diagnostics),
        }

    def __repr__(self) -> str:
        """Show the value with as many digits as its error leaves meaningful."""
        state = "" if self.converged else ", converged=False"
        shown = _with_error(self.value, self.standard_error)
        return f"Estimate({shown}, n={self.n}, replicates={self.replicates}, method={self.method!r}{state})"

    def _quantile(self, level: float) -> float:
        if math.isnan(self.degrees_of_freedom):
            return math.nan
        if self.sequential:
            return sequential_quantile(level, self.degrees_of_freedom)
        return float(intervals.student_quantile(level, self.degrees_of_freedom))

    def moments(self) -> Moments:
        """The moments of equal replicates, where they are all there is.

        Raises
        ------
        ValueError
            If there are none, or of several sizes.
        """
        moments = self.groups[0][1] if len(self.groups) == 1 else None
        if not isinstance(moments, Moments) or np.isnan(moments.third).any():
            raise ValueError("there are no moments of equal replicates, which intervals other than kind='t' need")
        return moments


def from_moments(groups: tuple[tuple[float, Summary], ...], *, method: str, cost: float, **rest: Any) -> Estimate:
    """The estimate from the moments, or the medians, of independent replicates.

    Parameters
    ----------
    groups : tuple of (float, Moments or Medians)
        Function values per replicate, and what is known of the replicates' means.
    method : str
        What made them.
    cost : float
        Function values in all.
    **rest
        Other attributes of `Estimate`.

    Returns
    -------
    Estimate
        The mean over groups, weighted with function values.
    """
    pooled = _pooled(groups)
    total = sum(size * moments.count for size, moments in pooled)
    shares = [size * moments.count / total for size, moments in pooled]
    value = sum(share * moments.mean for share, (_, moments) in zip(shares, pooled, strict=True))
    variances = [(share * moments.standard_error) ** 2 for share, (_, moments) in zip(shares, pooled, strict=True)]
    return Estimate(
        value=plain(value),
        standard_error=plain(np.sqrt(sum(variances))),
        n=round(total),
        replicates=sum(moments.count for _, moments in pooled),
        cost=cost,
        method=method,
        degrees_of_freedom=_degrees(variances, [moments.degrees for _, moments in pooled]),
        groups=pooled,
        **rest,
    )


def from_error(estimate: Estimate, **changes: Any) -> Estimate:
    """The same estimate with changes, able to merge although its error does not come from equal replicates.

    It counts as one more than its degrees of freedom replicates, whose spread is what its standard error says.
    """
    changed = replace(estimate, **changes)
    if changed.groups or math.isnan(changed.degrees_of_freedom):
        return changed
    count = max(2, round(changed.degrees_of_freedom) + 1)
    value = np.asarray(changed.value, np.float64)
    second = np.asarray(changed.standard_error, np.float64) ** 2 * count * (count - 1)
    moments = Moments(count, value, second, np.full_like(value, math.nan))
    return replace(changed, groups=((changed.n / count, moments),))


def _pooled(groups: tuple[tuple[float, Summary], ...]) -> tuple[tuple[float, Summary], ...]:
    """Groups of the same size and kind as one, in order of size."""
    pooled: dict[tuple[float, str], Any] = {}
    for size, moments in groups:
        key = (size, type(moments).__name__)
        pooled[key] = pooled[key].merge(moments) if key in pooled else moments
    return tuple((size, pooled[size, kind]) for size, kind in sorted(pooled))


def _degrees(variances: list[Array], degrees: list[float]) -> float:
    """Degrees of freedom of a sum of means, NaN if one of them has none; of an array, the least."""
    if min(degrees) < 1:
        return math.nan
    if len(degrees) == 1:
        return float(degrees[0])
    return intervals.degrees_of_sum(variances, degrees)


def _student(estimate: Estimate, level: float) -> tuple[Any, Any]:
    half = estimate.half_width(level)
    return estimate.value - half, estimate.value + half


def _without_skewness(estimate: Estimate, level: float) -> tuple[Any, Any]:
    moments = estimate.moments()
    skew = moments.skewness / math.sqrt(moments.count)
    return intervals.bounds(estimate.value, estimate.standard_error, estimate._quantile(level), skew)


def _percentile_t(estimate: Estimate, level: float) -> tuple[Any, Any]:
    medians = any(isinstance(moments, Medians) for _, moments in estimate.groups)
    if medians or "replicates" not in estimate.diagnostics:
        raise ValueError("kind='percentile-t' needs replicates and their mean; kind='t' does not")
    low, high = bootstrap.percentile_t(np.asarray(estimate.diagnostics["replicates"]), level)
    return estimate.value - estimate.standard_error * high, estimate.value - estimate.standard_error * low


_KINDS = {"t": _student, "unskewed": _without_skewness, "percentile-t": _percentile_t}


def plain(number: Any) -> Any:
    """A float for a number, an array for an array."""
    array = np.asarray(number, np.float64)
    return float(array) if array.ndim == 0 else array


def _json(thing: Any) -> Any:
    if hasattr(thing, "_asdict"):
        return _json(thing._asdict())
    if isinstance(thing, dict):
        return {str(key): _json(value) for key, value in thing.items()}
    if isinstance(thing, list | tuple):
        return [_json(value) for value in thing]
    if isinstance(thing, np.ndarray | np.generic):
        return _json(thing.tolist())
    return None if isinstance(thing, float) and not math.isfinite(thing) else thing


def _with_error(value: Any, error: Any) -> str:
    if np.ndim(value):
        with np.errstate(invalid="ignore"):
            return f"array of shape {np.shape(value)}, largest error {np.max(error):.2g}"
    if not (math.isfinite(error) and error > 0):
        return f"{value!r}" if math.isnan(error) else f"{value!r} ± {error:.2g}"
    digits = max(0, min(16, 1 - math.floor(math.log10(error))))
    if digits > 8 or error >= 1e6:
        orders = math.floor(math.log10(abs(value))) - math.floor(math.log10(error)) if value else 0
        significant = max(1, min(17, 2 + orders))
        return f"{value:.{significant}g} ± {error:.2g}"
    return f"{value:.{digits}f} ± {error:.{digits}f}"
