"""The star discrepancy: the largest error over all boxes from the origin, exact or bounded."""

import operator
from collections.abc import Callable
from typing import Any, Literal, NamedTuple, SupportsIndex, get_args

import numpy as np
import numpy.typing as npt

from evenlight import _core

from .rows import as_rows
from .worst_set import Kind, WorstSetDiscrepancy

__all__ = ["StarDiscrepancy", "star_discrepancy", "star_discrepancy_cost"]

Method = Literal["auto", "certain", "sweep", "dem", "threshold_accepting", "bracketing"]


class Evidence(NamedTuple):
    """What is known besides the number itself."""

    kind: Kind
    box: tuple[float, ...]
    closed: bool
    attained: float
    method: str


class StarDiscrepancy(WorstSetDiscrepancy[Evidence]):
    """A star discrepancy or a bound: a number that says which.

    Attributes
    ----------
    value : float
        The number itself.
    kind : {"exact", "lower", "upper"}
        Whether the star discrepancy is, is at least, or is at most this.
    box : ndarray, shape (d,)
        The upper corner of the worst box that is known.
    closed : bool
        Whether that box is [0, corner] and has too many points; otherwise it is [0, corner) and has too few.
    attained : float
        The discrepancy of that box: a lower bound in any case.
    lower, upper : float
        Between these the star discrepancy certainly is.
    method : str
        The algorithm that was used.

    Examples
    --------
    >>> from evenlight import quality
    >>> star = quality.star_discrepancy([[0.5, 0.5]])
    >>> float(star), star.kind, star.box.tolist(), star.closed
    (0.75, 'exact', [0.5, 0.5], True)
    """

    @property
    def box(self) -> npt.NDArray[np.float64]:
        """The upper corner of the worst box that is known."""
        return np.array(self.evidence.box)

    @property
    def attained(self) -> float:
        """The discrepancy of that box."""
        return self.evidence.attained

    @property
    def lower(self) -> float:
        """The star discrepancy is at least this."""
        return self.evidence.attained

    @property
    def upper(self) -> float:
        """The star discrepancy is at most this; 1 if nothing better is known."""
        return 1.0 if self.kind == "lower" else float(self)

    @property
    def method(self) -> str:
        """The algorithm that was used."""
        return self.evidence.method


def star_discrepancy(
    x: npt.ArrayLike,
    method: Method = "auto",
    *,
    progress: Callable[[float], object] | None = None,
    workers: SupportsIndex = 1,
    seed: SupportsIndex = 0,
    **limits: float,
) -> StarDiscrepancy:
    """Find the largest |points inside / n − volume| over all boxes from the origin.

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1].
    method : str
        - "sweep": exact, for d ≤ 2; O(n log n) and O(n log² n).
        - "dem": exact, for d ≥ 2; at most O(n^(1 + d/2)), see `star_discrepancy_cost`.
        - "threshold_accepting": a lower bound, the discrepancy of the worst box that random walks meet.
        - "bracketing": an upper bound that is guaranteed, refined until a limit is met; exact if the bounds meet.
        - "auto": "sweep" for d ≤ 2; else "dem" if that is expected to take at most `limit` steps; else
          "threshold_accepting".
        - "certain": the same, but with "bracketing" instead: never a lower bound.
    progress : callable, optional
        Called now and then with the part that is done, from 0 to 1, by "dem" and "bracketing". An exception of it
        stops the work.
    workers : int
        Threads of "dem"; they change no bit.
    seed : int
        Of the random walks, which also give "dem" and "bracketing" a box to beat. The same seed gives the same bits.
    **limits
        ``trials=10, steps=4096``: the walks and the steps of each. ``brackets=131072, width=0``: "bracketing" stops
        when it has made so many, or when the bounds are so close. ``limit=1e10``: for "auto" and "certain".

    Returns
    -------
    StarDiscrepancy
        A number in (0, 1] that says whether it is exact or a bound, and which box attains it.

    Raises
    ------
    ValueError
        If a number is not in [0, 1], or a method or limit has no meaning.

    Notes
    -----
    Finding it is NP-hard in d. Algorithms: Bundschuh and Zhu 1993 by a kinetic sweep; Dobkin, Eppstein and Mitchell
    1996 with bounds; Gnewuch, Wahlström and Winzen 2012; brackets after Thiémard 2001.

    Examples
    --------
    >>> from evenlight import points, quality
    >>> x = points.Sobol(3, scramble="none").points(0, 128)
    >>> star = quality.star_discrepancy(x)
    >>> print(f"{star:.6f}", star.kind, star.method)
    0.047516 exact dem
    >>> lower = quality.star_discrepancy(x, "threshold_accepting")
    >>> upper = quality.star_discrepancy(x, "bracketing", brackets=10_000)
    >>> lower.kind, upper.kind, lower <= star <= upper
    ('lower', 'upper', True)
    """
    if method not in get_args(Method):
        raise ValueError(f"unknown method {method!r}; known: {', '.join(get_args(Method))}")
    settings: dict[str, Any] = {
        "trials": 10,
        "steps": 4096,
        "brackets": 1 << 17,
        "width": 0.0,
        "limit": 1e10,
    }
    for name, value in limits.items():
        if name not in settings:
            raise ValueError(f"unknown limit {name!r}; known: {', '.join(settings)}")
        if not value >= (0 if name in ("width", "limit") else 1):
            raise ValueError(f"{name} must be at least {0 if name in ('width', 'limit') else 1}, not {value}")
        settings[name] = value if name in ("width", "limit") else operator.index(value)  # type: ignore[arg-type]
    if operator.index(workers) < 1:
        raise ValueError(f"workers must be at least 1, not {workers}")
    rows = as_rows(x)
    if method == "certain":
        feasible = rows.shape[1] <= 2 or star_discrepancy_cost(rows, seed=seed) <= settings["limit"]
        method = "auto" if feasible else "bracketing"
        settings["limit"] = np.inf
    settings |= {"method": method, "seed": operator.index(seed), "workers": operator.index(workers)}
    value, kind, box, attained, closed, used = _core.star_discrepancy(rows, settings, progress)
    return StarDiscrepancy(value, Evidence(kind, tuple(box), closed, attained, used))  # type: ignore[arg-type]


def star_discrepancy_cost(x: npt.ArrayLike, *, seed: SupportsIndex = 0) -> float:
    """Estimate how many steps the exact star discrepancy takes with "dem".

    Parameters
    ----------
    x : array_like, shape (n, d)
        Points in [0, 1].
    seed : int
        Of the random descents.

    Returns
    -------
    float
        Steps, of some nanoseconds each: the mean over 256 random descents into the tree of cells (Knuth 1975).
        Unbiased, but with a skewed spread, the more so the larger d: right to a factor of a few.

    Raises
    ------
    ValueError
        If a number is not in [0, 1].

    Examples
    --------
    >>> from evenlight import points, quality
    >>> x = points.Sobol(3).points(0, 128)
    >>> quality.star_discrepancy_cost(x) < 1e7
    True
    """
    return _core.star_discrepancy_cost(as_rows(x), operator.index(seed))
