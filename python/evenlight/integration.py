"""Integration: the mean of a function over points, with an error that can be trusted."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NoReturn, SupportsIndex

import numpy as np
from tqdm import tqdm

from evenlight.arguments import check_points, integer
from evenlight.estimate import Estimate, NotConvergedWarning
from evenlight.integrand import Integrand
from evenlight.intervals import check_level
from evenlight.quality import Variation, koksma_hlawka_bound, star_discrepancy
from evenlight.rules import Rule, choose
from evenlight.stopping import GROWTH

__all__ = ["integrate"]

_MOST_STEPS = 1e9  # of the exact star discrepancy: some seconds
_CONFIRMATIONS = 8  # rows, in multiples of the first look, before replicates without any spread are believed


def integrate(
    f: Callable[[Any], Any],
    points: Any,
    *,
    n: SupportsIndex | None = None,
    rtol: float | None = None,
    atol: float | None = None,
    replicates: SupportsIndex = 16,
    level: float = 0.95,
    max_n: SupportsIndex = 2**24,
    progress: bool | Callable[[dict[str, Any]], None] = False,
    method: str = "auto",
    domain: Any = None,
    bound: float | None = None,
    variation: Variation | float | None = None,
    resume: Estimate | None = None,
    on_nonfinite: str = "raise",
) -> Estimate:
    """Integrate a function over the unit cube, or over a domain.

    Give either `n` or a tolerance.

    Parameters
    ----------
    f : callable
        From an array of points, shape (m, d), to values of shape (m,) or (m, ...).
    points : evenlight.points.Engine
        Where to look, of d dimensions, such as ``Sobol(d, seed=7)``.
    n : int, optional
        Function values in all; with replicates a multiple of their number. Best a power of 2 per replicate.
    rtol, atol : float, optional
        Work until the interval is within ``max(atol, rtol * |integral|)`` of the value, for every entry of an array.
    replicates : int
        Independent randomizations, at least 2, that the error is judged by. Without effect on "mc" and "qmc". Up to a
        tolerance, 8 take a tenth fewer values than 16, but for smooth f a quarter; lattices fewer than nets for some.
    level : float
        The share of runs whose error is to be within the tolerance.
    max_n : int
        The most function values to spend on a tolerance.
    progress : bool or callable
        True for a progress bar; or a function of a dict with `done`, `total` and `relative_error`.
    method : {"auto", "mc", "qmc", "rqmc", "median"}
        How values become an estimate. "auto": "mc" for independent points, "qmc" for unscrambled ones, else "rqmc".
    domain : object, optional
        What maps the unit cube to where `f` lives: one of `evenlight.domains`, or anything with `d`, `map(u)` and
        `volume`. The integral is then over the domain, or under its density.
    bound : float, optional
        For "qmc", a bound on the error that is known.
    variation : Variation or float, optional
        For "qmc", the variation in the sense of Hardy and Krause of f (of ``volume * f(map(u))`` where there is a
        `domain`), see `evenlight.quality.hardy_krause_variation`. The star discrepancy of the points is then computed,
        exactly or as an upper bound, and the product bounds the error (Koksma and Hlawka); it is among the diagnostics.
    resume : Estimate, optional
        What the same call gave for fewer values, or up to a larger tolerance: its values are not computed again. Its
        intervals are widened as those of a run up to a tolerance are, for it was looked at before it went on.
    on_nonfinite : {"raise", "skip-and-count"}
        Whether a NaN or an infinity is an error, or left out; their number is then in the diagnostics.

    Returns
    -------
    Estimate
        The integral. `converged` is False where `max_n` came before the tolerance. Of a run up to a tolerance,
        ``diagnostics["looks"]`` has function values, value and standard error at every look.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above, or `f` returns what it should not; the message names it.

    Warns
    -----
    NotConvergedWarning
        If `max_n` came before the tolerance.

    Notes
    -----
    A run up to a tolerance doubles its points and looks again. Stopping at the first look that seems good enough
    would break the promise of the interval; `evenlight.stopping` widens the interval just enough to keep it.
    The first look is at 1,024 values, or 128 of each replicate. Values that are all alike are believed only after
    eight times as many. The error of "rqmc" is judged by the spread of the replicates, see
    `Estimate.confidence_interval`.

    Examples
    --------
    >>> import numpy as np
    >>> import evenlight
    >>> from evenlight.points import Sobol
    >>> gaussian = lambda x: np.exp(-(x**2).sum(axis=1))
    >>> estimate = evenlight.integrate(gaussian, Sobol(3, seed=7), rtol=1e-4)
    >>> estimate.converged, bool(abs(estimate.value - 0.4165383858866382) < 1e-4 * 0.4165)
    (True, True)
    """
    check_points(points)
    goal = _Goal.of(n, rtol, atol, level, max_n)
    if bound is not None and variation is not None:
        raise ValueError("bound and variation both bound the error; give one of them")
    integrand = Integrand(f, domain, on_nonfinite)
    if domain is not None and domain.d != points.d:
        raise ValueError(f"the domain takes points of {domain.d} dimensions; {points!r} has {points.d}")
    kind = choose(method, points)
    rule = kind(integrand, points, integer("replicates", replicates, 1))
    if rule.has_error and not (bound is None and variation is None):
        raise ValueError(f"a bound goes with method 'qmc', not {rule.name!r}, which has an error estimate")
    done = 0 if resume is None else _go_on(rule, points, resume, goal)
    with _Bar(progress, goal.most) as bar:
        estimate = _exactly(rule, goal.most) if goal.fixed else _until(rule, points, goal, done, bar)
    diagnostics = dict(estimate.diagnostics)
    if on_nonfinite != "raise":
        diagnostics["skipped"] = integrand.skipped
    if bound is not None:
        diagnostics["bound"] = float(bound)
    if variation is not None:
        diagnostics |= _koksma_hlawka(points, estimate, variation)
    message = "deterministic points: the error is at most the bound" if "bound" in diagnostics else estimate.message
    sequential = estimate.sequential or resume is not None
    return replace(estimate, diagnostics=diagnostics, message=message, sequential=sequential)


def _go_on(rule: Rule, points: Any, earlier: Estimate, goal: _Goal) -> int:
    """Give a rule what an earlier run knows, if it was of the same points and counted all of them; say how many."""
    if not isinstance(earlier, Estimate):
        raise TypeError(f"resume must be an estimate, not {type(earlier).__name__}")
    if getattr(points, "finite", False):
        raise ValueError(f"{points!r} cannot grow; resume needs a sequence such as Sobol")
    if earlier.method != rule.name or earlier.diagnostics.get("points") != (repr(points),):
        raise ValueError(f"resume must be an estimate by {rule.name!r} from {points!r}, not {earlier!r}")
    if rule.copies not in (1, earlier.replicates):
        raise ValueError(f"resume has {earlier.replicates} replicates, not {rule.copies}")
    if earlier.cost > goal.most:
        raise ValueError(f"resume has {earlier.cost:.0f} function values already, more than {goal.most}")
    if earlier.diagnostics.get("skipped"):
        raise ValueError("resume left out points, and does not know which of its replicates they were of")
    rule.resume(earlier)
    return round(earlier.cost) // rule.copies


def _koksma_hlawka(points: Any, estimate: Estimate, variation: Variation | float) -> dict[str, Any]:
    """The bound on the error of a mean over fixed points, and the discrepancy it is made of."""
    if estimate.cost != estimate.n:
        raise ValueError("a function that is not finite at some points has no finite variation")
    star = star_discrepancy(points.points(0, estimate.n), "certain", limit=_MOST_STEPS)
    return {"bound": koksma_hlawka_bound(variation, star), "star_discrepancy": star, "variation": variation}


@dataclass(frozen=True)
class _Goal:
    """When a run is over."""

    most: int
    fixed: bool
    rtol: float
    atol: float
    level: float

    @classmethod
    def of(cls, n: Any, rtol: float | None, atol: float | None, level: float, max_n: Any) -> _Goal:
        check_level(level)
        if n is not None:
            if rtol is not None or atol is not None:
                raise ValueError("n and a tolerance both say when to stop; give one of them")
            return cls(integer("n", n, 1), True, 0.0, 0.0, level)
        if rtol is None and atol is None:
            raise ValueError("give n, the number of function values, or a tolerance: rtol or atol")
        for name, value in (("rtol", rtol), ("atol", atol)):
            if value is not None and not 0.0 <= value < math.inf:
                raise ValueError(f"{name} must be at least 0, not {value}")
        if not (rtol or atol):
            raise ValueError("a tolerance of 0 is never reached; give rtol or atol above 0")
        return cls(integer("max_n", max_n, 1), False, rtol or 0.0, atol or 0.0, level)

    def reached(self, estimate: Estimate) -> bool:
        """Whether |value - truth| <= max(atol, rtol |truth|) as far as the interval can tell."""
        half = np.asarray(estimate.half_width(self.level))
        relative = self.rtol / (1.0 + self.rtol) * np.abs(estimate.value)
        return bool(np.all(half <= np.maximum(self.atol, relative)))


def _exactly(rule: Rule, n: int) -> Estimate:
    if n % rule.copies:
        near = max(1, round(n / rule.copies)) * rule.copies
        raise ValueError(f"n = {n} is no multiple of {rule.copies} replicates; {near} is")
    rule.extend(n // rule.copies)
    estimate = rule.estimate()
    return replace(estimate, message=estimate.message or "as many function values as asked")


def _until(rule: Rule, points: Any, goal: _Goal, done: int, bar: _Bar) -> Estimate:
    if not rule.has_error:
        raise ValueError(f"method {rule.name!r} has no error estimate to stop by; give n, or scrambled points")
    if getattr(points, "finite", False):
        raise ValueError(f"{points!r} cannot grow up to a tolerance; give n, or a sequence such as Sobol")
    most = goal.most // rule.copies
    if most < 2:
        raise ValueError(f"max_n = {goal.most} is not enough for {rule.copies} replicates")
    rows = min(max(rule.first, done), most)
    looks: list[tuple[int, Any, Any]] = []
    while True:
        rule.extend(rows)
        estimate = rule.estimate()
        looks.append((estimate.n, estimate.value, estimate.standard_error))
        estimate = replace(estimate, sequential=True, diagnostics=estimate.diagnostics | {"looks": looks})
        bar.show(estimate)
        if goal.reached(estimate) and (rows >= _CONFIRMATIONS * rule.first or np.all(estimate.standard_error)):
            return replace(estimate, message="tolerance reached")
        if rows >= most:
            break
        rows = min(int(rows * GROWTH), most)
    message = f"max_n = {goal.most} reached before the tolerance"
    warnings.warn(f"{message}: {estimate!r}", NotConvergedWarning, stacklevel=3)
    return replace(estimate, converged=False, message=message)


class _Bar:
    """Progress, as a bar or by a function; nothing unless asked for."""

    def __init__(self, progress: bool | Callable[[dict[str, Any]], None], total: int) -> None:
        self._function = progress if callable(progress) else None
        self._bar: tqdm[NoReturn] | None = None
        self._total = total
        if progress is True:
            self._bar = tqdm(total=total, unit="value", unit_scale=True, dynamic_ncols=True, leave=False)

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def show(self, estimate: Estimate) -> None:
        with np.errstate(invalid="ignore", divide="ignore"):
            relative = float(np.max(np.asarray(estimate.standard_error) / np.abs(estimate.value)))
        if self._function is not None:
            self._function({"done": int(estimate.cost), "total": self._total, "relative_error": relative})
        if self._bar is not None:
            self._bar.set_postfix_str(f"error {relative:.2%}", refresh=False)
            self._bar.update(int(estimate.cost) - self._bar.n)
