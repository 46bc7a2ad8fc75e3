"""Importance sampling: from one density, from several with heuristics, from mixtures with optimal weights."""

from evenlight.importance.adaptive import LearnedMixture, adaptive_estimate, learn_mixture
from evenlight.importance.densities import DENSITIES, Callables, Density, Normal, StudentT, Univariate, as_density
from evenlight.importance.diagnostics import effective_sample_size, tail_index
from evenlight.importance.heuristics import HEURISTICS, weights
from evenlight.importance.mixture_estimate import mixture_estimate
from evenlight.importance.multiple import multiple_importance
from evenlight.importance.optimal import OptimalMixture, optimal_mixture
from evenlight.importance.plain import importance_sampling
from evenlight.importance.vegas_grid import vegas_estimate

__all__ = [
    "DENSITIES",
    "HEURISTICS",
    "Callables",
    "Density",
    "LearnedMixture",
    "Normal",
    "OptimalMixture",
    "StudentT",
    "Univariate",
    "adaptive_estimate",
    "as_density",
    "effective_sample_size",
    "importance_sampling",
    "learn_mixture",
    "mixture_estimate",
    "multiple_importance",
    "optimal_mixture",
    "tail_index",
    "vegas_estimate",
    "weights",
]
