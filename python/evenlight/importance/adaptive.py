"""Adaptive mixtures: components and weights learned over several rounds, for integrands nobody has proposals for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, SupportsIndex

import numpy as np

from evenlight.estimate import Estimate, from_error
from evenlight.importance.densities import Density
from evenlight.importance.densities.density import Array
from evenlight.importance.mixture import Mixture, counts
from evenlight.importance.mixture_estimate import mixture_estimate, values
from evenlight.importance.optimal import optimal_mixture
from evenlight.integrand import Integrand
from evenlight.points import Independent

__all__ = ["LearnedMixture", "adaptive_estimate", "learn_mixture"]

_DEFENSIVE = 0.1  # the target's share while components move
_STEPS = 2  # of fitting in each round


class LearnedMixture(NamedTuple):
    """What a run of learning found."""

    proposals: tuple[Density, ...]
    """The components: those that moved, the proposals of the beginning, the target last."""
    alpha: Array
    """Their optimal weights."""
    gap: float
    """The relative duality gap of the weights, on all points seen."""
    n: int
    """Function values spent."""


def learn_mixture(
    f: Callable[[Any], Any],
    target: Any,
    proposals: Sequence[Any],
    *,
    n: int = 20_000,
    rounds: int = 4,
    aim: Literal["variance", "entropy", "weights"] = "variance",
    floor: Any = None,
    seed: SupportsIndex = 0,
) -> LearnedMixture:
    """Fit the components of a mixture to where an integrand needs points, round by round.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,).
    target : density
        p, normalized; it stays among the components, as the defensive one.
    proposals : sequence of densities
        To begin with. `Normal` and `StudentT` ones move; all others keep their place.
    n : int
        Function values in all.
    rounds : int
        Into which they are divided.
    aim : {"variance", "entropy", "weights"}
        What the components are fitted to: "variance" to the second moment, as in the method of variance minimization;
        "entropy" to |f p|, as in population Monte Carlo and the method of cross-entropy; "weights" leaves them alone.
    floor : float or array_like, optional
        Least weights in the end; 0.1 / J by default.
    seed : int
        Same seed, same bits.

    Returns
    -------
    LearnedMixture
        With those of the components met that carry weight in the best mixture, and the proposals of the beginning.

    Raises
    ------
    ValueError
        If an argument is not as above, or f p was 0 at all points of the first round.

    Notes
    -----
    All points of all rounds count in every fit, each by the mean density of all rounds, which no single bad round can
    spoil: J.-M. Cornuet, J.-M. Marin, A. Mira and C. P. Robert, Scand. J. Stat. 39(4), 798-812 (2012). Components share
    points by their responsibilities: O. Cappé, R. Douc, A. Guillin, J.-M. Marin and C. P. Robert, Stat. Comput. 18,
    447-459 (2008). After every round the optimal weights of old and new components say which to keep, so that no fit
    can make matters worse. Weights are truncated as in E. L. Ionides, J. Comput. Graph. Stat. 17(2), 295-311 (2008).

    Examples
    --------
    >>> from evenlight.importance import Normal, learn_mixture
    >>> p = Normal([0.0, 0.0])
    >>> learned = learn_mixture(lambda x: x[:, 0] > 4, p, [Normal([3.0, 0.0]), Normal([-3.0, 0.0])], n=6000)
    >>> learned.n, learned.gap <= 1e-3
    (6000, True)
    """
    if aim not in ("variance", "entropy", "weights"):
        raise ValueError(f"aim must be 'variance', 'entropy' or 'weights', not {aim!r}")
    if not 1 <= rounds <= n // (len(proposals) + 1):
        raise ValueError(f"{n} values are not enough for {rounds} rounds of {len(proposals) + 1} components")
    start = Mixture(target, proposals)
    learning = _Learning(Integrand(f, None, "raise"), start, aim)
    source = Independent(start.uniforms, seed=seed)
    for number in range(rounds):
        learning.look(source.replicate(number), n // rounds + (number < n % rounds))
        if aim == "weights":
            learning.reweigh(floor)
        else:
            learning.fit()
    return learning.learned(floor, n)


def adaptive_estimate(
    f: Callable[[Any], Any],
    target: Any,
    proposals: Sequence[Any],
    *,
    n: int = 100_000,
    learn: float = 0.2,
    seed: SupportsIndex = 0,
    **settings: Any,
) -> Estimate:
    """Learn a mixture, then estimate the mean of f under the target with it.

    Parameters
    ----------
    f, target, proposals
        As for `learn_mixture`.
    n : int
        Function values in all.
    learn : float
        The share of them to learn from; they do not count in the estimate, which so has no bias from learning.
    seed : int
        Same seed, same bits.
    **settings
        Of `learn_mixture`: `rounds`, `aim`, `floor`.

    Returns
    -------
    Estimate
        That of `mixture_estimate` with control variates.

    Raises
    ------
    ValueError
        If an argument is not as above.

    Examples
    --------
    >>> from evenlight.importance import Normal, adaptive_estimate
    >>> p = Normal([0.0, 0.0])
    >>> estimate = adaptive_estimate(lambda x: x[:, 0] > 4, p, [Normal([3.0, 0.0])], n=20_000)
    >>> bool(abs(estimate.value / 3.167124183e-5 - 1) < 0.02)
    True
    """
    if not 0 < learn < 1:
        raise ValueError(f"learn must be between 0 and 1, not {learn}")
    learned = learn_mixture(f, target, proposals, n=int(n * learn), seed=seed, **settings)
    estimate = mixture_estimate(
        f,
        target,
        learned.proposals,
        alpha=learned.alpha,
        n=n - learned.n,
        seed=Independent(1, seed=seed).replicate(0).seed,
    )
    diagnostics = estimate.diagnostics | {"gap": learned.gap}
    return from_error(estimate, method="adaptive mixture", cost=float(n), diagnostics=diagnostics)


class _Learning:
    """All points so far, and the components as they are now."""

    def __init__(self, integrand: Integrand, start: Mixture, aim: str) -> None:
        self._integrand = integrand
        self._target = start.target
        self._aim = aim
        self.components: list[Density] = [q for q in start.proposals if q is not start.target] + [start.target]
        self._first, self._moved = self.components, list[Density]()
        self._first_densities = np.empty((0, len(self._first)))
        share = (1 - _DEFENSIVE) / max(1, len(self.components) - 1)
        self.alpha = np.append(np.full(len(self.components) - 1, share), 1 - share * (len(self.components) - 1))
        self._history: list[tuple[int, list[Density], Array]] = []
        self._x = np.empty((0, start.d))
        self._spent = np.empty(0)
        self.y = np.empty(0)

    def look(self, source: Any, size: int) -> None:
        """Draw a round from the mixture as it is now, and evaluate it."""
        mixture = Mixture(self._target, self.components)
        component = np.repeat(np.arange(len(mixture)), counts(self.alpha, size))
        sample = mixture.at(component, source.points(0, size))
        scale = np.exp(self._target.logpdf(sample.x)) / np.where(sample.target > 0, sample.target, 1.0)
        self.y = np.concatenate([self.y, values(self._integrand, sample) * scale])
        self._history.append((size, self.components, self.alpha))
        # the sum over rounds of size times density: the old points learn of the new round, the new ones of all
        old = self._spent + size * _density(self._x, self.components, self.alpha)
        new = np.zeros(size)
        for count, components, alpha in self._history:
            new += count * _density(sample.x, components, alpha)
        self._spent = np.concatenate([old, new])
        self._x = np.concatenate([self._x, sample.x])
        self._first_densities = np.concatenate([self._first_densities, _densities(sample.x, self._first)])
        if not self.y.any():
            raise ValueError(f"f p is 0 at all {len(self.y)} points of the first round; begin with better proposals")

    def spent_density(self) -> Array:
        """The mean density of all rounds at all points."""
        return self._spent / len(self._spent)

    def densities(self) -> Array:
        """Those of the components as they are now, at all points, shape (n, J)."""
        return _densities(self._x, self.components)

    def learned(self, floor: Any, n: int) -> LearnedMixture:
        """What moved, and the proposals of the beginning, which floors keep as an insurance; optimal weights."""
        q = (
            np.column_stack([_densities(self._x, self._moved), self._first_densities])
            if self._moved
            else self._first_densities
        )
        best = optimal_mixture(self.y, q, self.spent_density(), floor=floor)
        return LearnedMixture((*self._moved, *self._first), best.alpha, best.gap, n)

    def reweigh(self, floor: Any) -> None:
        """Take the optimal weights for what was seen so far."""
        self.alpha = optimal_mixture(self.y, self.densities(), self.spent_density(), floor=floor).alpha

    def fit(self) -> None:
        """Move the components towards where f p, or its second moment, is; take the best of old and new ones."""
        components, alpha, q = self.components, self.alpha, self.densities()
        old = q
        for _ in range(_STEPS):
            mixed = q @ alpha
            weights = np.abs(self.y) / self._spent
            if self._aim == "variance":
                weights = weights * np.abs(self.y) / mixed
            weights = np.minimum(weights, weights.mean() * np.sqrt(len(weights)))
            shared = q[:, :-1] * alpha[:-1] * (weights / mixed)[:, np.newaxis]
            mass = shared.sum(axis=0)
            kept = np.flatnonzero(mass > 1e-4 * mass.sum())
            components = [*(components[k].fitted(self._x, shared[:, k]) for k in kept), self._target]
            alpha = np.append((1 - _DEFENSIVE) * mass[kept] / mass[kept].sum(), _DEFENSIVE)
            q = _densities(self._x, components)
        candidates = [*components[:-1], *self._moved, *self._first]
        moved = [k for k, component in enumerate(self.components) if any(component is m for m in self._moved)]
        self._choose(candidates, np.column_stack([q[:, :-1], old[:, moved], self._first_densities]))

    def _choose(self, candidates: list[Density], q: Array) -> None:
        """Keep the candidates that carry weight in the best mixture of them all, and the target.

        The proposals of the beginning are always candidates: what moved may have left something uncovered.
        """
        floor = 0.1 / len(candidates)
        best = optimal_mixture(self.y, q, self.spent_density(), floor=floor, control_variates=False)
        chosen = np.union1d(np.flatnonzero(best.alpha > 1.5 * floor), [len(candidates) - 1])
        self.components = [candidates[k] for k in chosen]
        self._moved = [component for component in self.components if not any(component is q for q in self._first)]
        self.alpha = np.maximum(best.alpha[chosen], 0.1 / len(chosen))
        self.alpha /= self.alpha.sum()


def _densities(x: Array, components: list[Density]) -> Array:
    return np.stack([np.exp(component.logpdf(x)) for component in components], axis=1)


def _density(x: Array, components: list[Density], alpha: Array) -> Array:
    total = np.zeros(len(x))
    for share, component in zip(alpha, components, strict=True):
        total += share * np.exp(component.logpdf(x))
    return total
