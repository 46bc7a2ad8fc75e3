"""True variances of mixture estimates, by integration where samples would see far too little of them."""

from __future__ import annotations

from typing import Any, NamedTuple, SupportsIndex

import numpy as np

from evenlight.importance.mixture import Mixture
from evenlight.integration import integrate
from evenlight.lab.mixture_problems import Array, MixtureProblem
from evenlight.points import Sobol

__all__ = ["VarianceConstants", "variance_constants"]


class VarianceConstants(NamedTuple):
    """n times the variance of an estimate from n points of a mixture."""

    independent: float
    """Components drawn at random, no control variates."""
    fixed_counts: float
    """n alpha_j points of each component."""
    control_variates: float
    """With the best coefficients; the same for both."""


def variance_constants(
    problem: MixtureProblem, alpha: Any, *, n: int = 2**18, seed: SupportsIndex = 0
) -> VarianceConstants:
    """Integrate the second moments of a mixture estimate.

    Parameters
    ----------
    problem : MixtureProblem
        Integrand, densities, and points under which its second moment is smooth.
    alpha : array_like, shape (J,)
        Weights of the mixture, of sum 1.
    n : int
        Function values of each of two integrations by scrambled Sobol' points.
    seed : int
        Of the points.

    Returns
    -------
    VarianceConstants
        The three constants.

    Examples
    --------
    >>> from evenlight.lab import singularity, variance_constants
    >>> alone = variance_constants(singularity(), [0] * 10 + [1], n=2**14)
    >>> bool(abs(alone.independent / 0.7109642 - 1) < 0.02)
    True
    """
    mixture = Mixture(problem.target, problem.proposals)
    weights = np.asarray(alpha, np.float64)

    def moments(u: Array) -> Array:
        """(f p)² / q_alpha and f p q_j / q_alpha; a point far out, where all densities are 0, has nothing to add."""
        x, jacobian = problem.locate(u)
        logs = np.stack([proposal.logpdf(x) for proposal in problem.proposals], axis=1)
        largest = logs.max(axis=1)
        q = np.exp(logs - largest[:, np.newaxis])
        with np.errstate(divide="ignore", over="ignore"):
            fp = problem.f(x) * np.exp(problem.target.logpdf(x))
        t = np.maximum(q @ weights, 1e-300)
        columns = np.column_stack([fp * np.exp(-largest) * fp / t, fp[:, np.newaxis] * q / t[:, np.newaxis]])
        return np.asarray(np.where(jacobian[:, np.newaxis] > 0, columns * jacobian[:, np.newaxis], 0.0))

    def products(u: Array) -> Array:
        """The q_i q_j / q_alpha², whose mean under the mixture is the Gram matrix."""
        sample = mixture.draw(weights, u)
        ratio = sample.q / (sample.q @ weights)[:, np.newaxis]
        return np.asarray(ratio[:, :, np.newaxis] * ratio[:, np.newaxis, :])

    first = integrate(moments, Sobol(problem.uniforms, seed=seed), n=n).value
    gram = integrate(products, Sobol(mixture.uniforms, seed=seed), n=n).value
    second, means = float(first[0]), first[1:]
    explained = float(means @ np.linalg.pinv(gram, rcond=1e-9, hermitian=True) @ means)
    independent = second - problem.exact**2
    spread = float(weights @ (means - problem.exact) ** 2)
    return VarianceConstants(independent, independent - spread, second - explained)
