"""The state of an adaptive mixture: all points of all rounds, and components that move towards an integrand."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenlight.importance.densities import Density
from evenlight.importance.densities.density import Array
from evenlight.importance.mixture import Mixture, Sample, counts
from evenlight.importance.mixture_estimate import values
from evenlight.importance.mixture_objective import together
from evenlight.importance.optimal import optimal_mixture
from evenlight.integrand import Integrand

__all__ = ["Learning"]

_DEFENSIVE = 0.1  # the target's share while components move
_STEPS = 2  # of fitting in each round
_ROUGH = 1e-2  # duality gap that is good enough to choose components by


class Learning:
    """All points so far, with the densities there of all components that any of them was drawn from.

    A component is evaluated once at every point. Densities at a point are over the largest one at the time it was
    drawn, which no ratio notices.

    Parameters
    ----------
    integrand : Integrand
        f.
    start : Mixture
        The target, and the components to begin with.
    aim : {"variance", "entropy", "weights"}
        See `learn_mixture`.
    """

    def __init__(self, integrand: Integrand, start: Mixture, aim: str) -> None:
        self._integrand = integrand
        self._aim = aim
        self._known: list[Density] = [q for q in start.proposals if q is not start.target] + [start.target]
        self._target = len(self._known) - 1
        self._first = self._now = np.arange(len(self._known))
        self._alpha = np.full(len(self._known), (1 - _DEFENSIVE) / max(1, self._target))
        self._alpha[-1] = 1 - self._alpha[:-1].sum()
        self._drawn = np.zeros(len(self._known))
        self._x = np.empty((0, start.d))
        self._scale = np.empty(0)
        self._q = np.empty((len(self._known), 0))
        self._rounds: list[Array] = []

    def look(self, source: Any, size: int) -> None:
        """Draw a round from the mixture as it is now, and evaluate it."""
        parts = np.split(source.points(0, size), np.cumsum(counts(self._alpha, size))[:-1])
        components = [self._known[k] for k in self._now]
        x = np.concatenate([q.sample(u[:, : q.uniforms]) for q, u in zip(components, parts, strict=True)])
        logs = np.stack([component.logpdf(x) for component in self._known])
        scale = logs.max(axis=0)
        q = np.exp(np.subtract(logs, scale, out=logs), out=logs)
        self._rounds.append(values(self._integrand, Sample(x, self._now, q.T, q[self._target])))
        self._x = np.concatenate([self._x, x])
        self._scale = np.concatenate([self._scale, scale])
        self._q = np.concatenate([self._q, q], axis=1)
        self._drawn[self._now] += size * self._alpha
        if not any(y.any() for y in self._rounds):
            raise ValueError(f"f p is 0 at all {len(self._x)} points of the first round; begin with better proposals")

    def learned(self, floor: Any) -> tuple[list[Density], Array, float]:
        """What moved, and the proposals of the beginning, which floors keep as an insurance; optimal weights; gap."""
        kept = np.concatenate([self._moved(), self._first])
        density = self._density()
        best = optimal_mixture(self._fp(density), self._q[kept].T, density, floor=floor, control_variates=False)
        return [self._known[k] for k in kept], best.alpha, best.gap

    def reweigh(self, floor: Any) -> None:
        """Take the optimal weights for what was seen so far."""
        density = self._density()
        best = optimal_mixture(self._fp(density), self._q[self._now].T, density, floor=floor, control_variates=False)
        self._alpha = best.alpha

    def fit(self) -> None:
        """Move the components towards where f p, or its second moment, is; take the best of old and new ones."""
        density = self._density()
        size = np.abs(self._fp(density))
        components, alpha, q = [self._known[k] for k in self._now], self._alpha, self._q[self._now]
        for _ in range(_STEPS):
            mixed = alpha @ q
            weights = size / density
            if self._aim == "variance":
                weights = weights * size / mixed
            weights = np.minimum(weights, weights.mean() * np.sqrt(len(weights)))
            shared = q[:-1] * (weights / mixed)
            mass = alpha[:-1] * shared.sum(axis=1)
            kept = np.flatnonzero(mass > 1e-4 * mass.sum())
            components = [components[k].fitted(self._x, alpha[k] * shared[k]) for k in kept]
            alpha = np.append((1 - _DEFENSIVE) * mass[kept] / mass[kept].sum(), _DEFENSIVE)
            components.append(self._known[self._target])
            q = np.stack([*(np.exp(c.logpdf(self._x) - self._scale) for c in components[:-1]), self._q[self._target]])
        self._choose(components[:-1], q[:-1], size, density)

    def _choose(self, fitted: list[Density], q: Array, size: Array, density: Array) -> None:
        """Keep the candidates that carry weight in the best mixture of them all, and the target.

        The proposals of the beginning are always candidates: what moved may have left something uncovered.
        """
        old = np.concatenate([self._moved(), self._first])
        candidates = np.concatenate([q, self._q[old]])
        floor = 0.1 / len(candidates)
        best = optimal_mixture(size, candidates.T, density, floor=floor, control_variates=False, gap=_ROUGH)
        chosen = np.union1d(np.flatnonzero(best.alpha > 1.5 * floor), [len(candidates) - 1])
        new = chosen[chosen < len(fitted)]
        self._now = np.concatenate([len(self._known) + np.arange(len(new)), old[chosen[len(new) :] - len(fitted)]])
        self._known += [fitted[k] for k in new]
        self._q = np.concatenate([self._q, q[new]])
        self._drawn = np.concatenate([self._drawn, np.zeros(len(new))])
        self._alpha = np.maximum(best.alpha[chosen], 0.1 / len(chosen))
        self._alpha /= self._alpha.sum()

    def _density(self) -> Array:
        """The mean density of all rounds at all points."""
        return np.asarray(self._drawn @ self._q / len(self._x))

    def _fp(self, density: Array) -> Array:
        """The integrand times the target's density, several as one."""
        y = np.concatenate(self._rounds)
        return together(y.reshape(len(y), -1), density)

    def _moved(self) -> Any:
        """Those of the present components that are not of the beginning."""
        return self._now[self._now >= len(self._first)]
