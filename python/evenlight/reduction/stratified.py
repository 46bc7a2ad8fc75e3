"""Stratification: parts of known weight, each with points of its own, more where the integrand varies more."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, SupportsIndex

import numpy as np

from evenlight.estimate import Estimate, from_error, plain
from evenlight.importance.mixture import counts
from evenlight.importance.strata import Strata
from evenlight.integrand import Integrand
from evenlight.points import Independent

__all__ = ["Stratum", "stratified"]


class Stratum(NamedTuple):
    """A part of the domain."""

    weight: float
    """Its share of the probability, or its volume."""
    domain: Any
    """What maps uniform points into it, with `d` and `map(u)`; a `volume` is not used."""


def stratified(
    f: Callable[[Any], Any],
    strata: Sequence[Stratum],
    *,
    n: int,
    allocation: Literal["neyman", "proportional"] = "neyman",
    pilot: float = 0.1,
    seed: SupportsIndex = 0,
) -> Estimate:
    """Estimate the sum over strata of weight times mean of f.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...).
    strata : sequence of Stratum
        At least one.
    n : int
        Function values in all, at least 4 per stratum.
    allocation : {"neyman", "proportional"}
        "neyman": points in proportion to weight times standard deviation, which a pilot sample estimates; the least
        variance there is, or for several values the least sum of variances, each over its squared mean of |f|.
        "proportional": to weight; never worse than no strata.
    pilot : float
        The pilot's share of n, for "neyman"; it does not count in the estimate, which so has no bias.
    seed : int
        Same seed, same bits.

    Returns
    -------
    Estimate
        With `counts` among the diagnostics.

    Raises
    ------
    ValueError
        If an argument is not as above.

    Notes
    -----
    J. Neyman, J. R. Stat. Soc. 97, 558-625 (1934). At least two points in every stratum.

    Examples
    --------
    >>> from evenlight.domains import Box
    >>> from evenlight.reduction import Stratum, stratified
    >>> strata = [Stratum(0.9, Box([0], [0.9])), Stratum(0.1, Box([0.9], [1]))]
    >>> estimate = stratified(lambda x: (x[:, 0] > 0.9) * x[:, 0], strata, n=1000)
    >>> bool(abs(estimate.value - 0.095) < 4 * estimate.standard_error), estimate.diagnostics["counts"].tolist()
    (True, [2, 898])
    """
    if not strata or n < 4 * len(strata):
        raise ValueError(f"{n} values are not enough for {len(strata)} strata: 4 for each are needed")
    if allocation not in ("neyman", "proportional"):
        raise ValueError(f"allocation must be 'neyman' or 'proportional', not {allocation!r}")
    weights = np.array([stratum.weight for stratum in strata], np.float64)
    if not (np.isfinite(weights).all() and weights.min() > 0):
        raise ValueError("weights must be finite and above 0")
    integrand = Integrand(f, None, "raise")
    shares, spent = weights, 0
    if allocation == "neyman":
        first = _spread(counts(weights, max(2 * len(strata), round(pilot * n))))
        shares = weights * _spreads(_sample(integrand, strata, first, seed, 0), weights)
        spent = int(first.sum())
        if not shares.any():
            shares = weights
    numbers = _spread(counts(shares, n - spent))
    y = np.concatenate(_sample(integrand, strata, numbers, seed, 1))
    shape = y.shape[1:]
    parts = Strata.of(y.reshape(len(y), -1), np.repeat(np.arange(len(strata)), numbers), len(strata))
    error, degrees = parts.error(weights)
    estimate = Estimate(
        value=plain((weights @ parts.means).reshape(shape)),
        standard_error=plain(error.reshape(shape)),
        n=int(numbers.sum()),
        replicates=int(numbers.sum()),
        cost=float(spent + numbers.sum()),
        method="stratified",
        message="as many function values as asked",
        diagnostics={"counts": numbers},
        degrees_of_freedom=degrees,
    )
    return from_error(estimate)


def _spreads(parts: list[Any], weights: Any) -> Any:
    """The standard deviation in every stratum, of several values together in units of their mean sizes."""
    deviations = np.stack([y.std(axis=0, ddof=1).ravel() for y in parts])
    sizes = weights @ np.stack([np.abs(y).mean(axis=0).ravel() for y in parts])
    return np.sqrt(((deviations[:, sizes > 0] / sizes[sizes > 0]) ** 2).sum(axis=1))


def _spread(numbers: Any) -> Any:
    """At least two of each, taken from the largest."""
    numbers = np.asarray(numbers).copy()
    while numbers.min() < 2:
        numbers[numbers.argmax()] -= 1
        numbers[numbers.argmin()] += 1
    return numbers


def _sample(
    integrand: Integrand, strata: Sequence[Stratum], numbers: Any, seed: SupportsIndex, stage: int
) -> list[Any]:
    """Values of f in every stratum, at points that no other stratum and stage has."""
    found = []
    for index, (stratum, number) in enumerate(zip(strata, numbers, strict=True)):
        source = Independent(int(stratum.domain.d), seed=seed).replicate(2 * index + stage)
        values, _ = integrand(stratum.domain.map(source.points(0, int(number))), 0)
        found.append(values)
    return found
