"""Two problems for mixtures: a singularity that is barely square-integrable, and an event of probability 2.5e-8."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import special

from evenlight.importance import Density, Normal
from evenlight.importance.mixture import Mixture
from evenlight.integrands.singular_point import mean_of_power

__all__ = ["MixtureProblem", "rare_event", "singularity"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MixtureProblem:
    """An integrand, its target density, proposals, and what is known of them."""

    f: Callable[[Array], Array]
    """The integrand, from points (n, d) to values (n,)."""
    target: Density
    """The density p."""
    proposals: tuple[Density, ...]
    """q_1 to q_J, the target last."""
    exact: float
    """The mean of f under p."""
    locate: Callable[[Array], tuple[Array, Array]]
    """From uniform numbers (n, `uniforms`) to points and weights under which (f p)² / q is smooth."""
    uniforms: int
    """How many uniform numbers `locate` takes."""


def singularity(gamma: float = 2.4, shrink: float = 2.0) -> MixtureProblem:
    """|x - 1|^-gamma for x normal with covariances 2^-|i - j| in 5 dimensions; narrow normals at 1, distractors at -1.

    The problem of H. Y. He and A. B. Owen, arXiv:1411.3954 (2014). The second moment is integrated in polar
    coordinates around the singularity, with the radius r = s^(1 / (5 - 2 gamma)), after which nothing is unbounded.

    Parameters
    ----------
    gamma : float
        Below 5/2, from where on the variance is infinite. The nearer, the more of the second moment lies next to the
        singularity, where the variance of plain sampling over that of a mixture is the ratio of their densities.
    shrink : float
        The proposals have the covariances shrink^-r, for r from 1 to 5.

    Returns
    -------
    MixtureProblem
        By default of mean 0.173866966666, with 11 proposals.

    Raises
    ------
    ValueError
        If gamma is not between 0 and 5/2.

    Examples
    --------
    >>> from evenlight.lab import singularity
    >>> round(singularity().exact, 12)
    0.173866966666
    """
    if not 0 < gamma < 2.5:
        raise ValueError(f"gamma must be between 0 and 5/2, not {gamma}: the variance would be infinite")
    one = np.ones(5)
    target = Normal(np.zeros(5), 2.0 ** -np.abs(np.subtract.outer(np.arange(5), np.arange(5))))
    narrow = [Normal(one, shrink**-r) for r in range(1, 6)]
    distractors = [Normal(-one, shrink**-r) for r in range(1, 6)]
    power = 5 - 2 * gamma
    longest, least = 12.0**power, 3e-9**power
    proposals = (*narrow, *distractors, target)
    mixture, even = Mixture(target, proposals), np.full(11, 1 / 11)

    def locate(u: Array) -> tuple[Array, Array]:
        """Half of the points in polar coordinates, half of the uniform mixture; one over their common density."""
        polar = u[:, 0] < 0.5
        chooser = np.where(polar, 2 * u[:, 0], 2 * u[:, 0] - 1)
        x = np.empty((len(u), 5))
        # nearer than 3e-9, x - 1 has no digits left, and the integrand is constant in s
        s = np.maximum(longest * chooser[polar], least)
        direction = special.ndtri(np.clip(u[polar, 1:], 2.0**-65, None))
        x[polar] = one + direction * (s ** (1 / power) / np.linalg.norm(direction, axis=1))[:, np.newaxis]
        x[~polar] = mixture.draw(even, np.column_stack([chooser, u[:, 1:]])[~polar]).x
        density = np.mean([np.exp(proposal.logpdf(x)) for proposal in proposals], axis=0)
        return x, 2.0 / (density + _polar_density(np.linalg.norm(x - one, axis=1), power))

    return MixtureProblem(
        f=lambda x: np.asarray(((x - 1) ** 2).sum(axis=1) ** (-gamma / 2)),
        target=target,
        proposals=proposals,
        exact=mean_of_power(target.covariance, one, gamma),
        locate=locate,
        uniforms=6,
    )


def _polar_density(radius: Array, power: float) -> Array:
    """Of points at a distance r below 12, r^power uniform, in a uniform direction, of area 8 pi² / 3 r^4."""
    r = np.maximum(radius, 3e-9)
    return np.where(r < 12.0, power / 12.0**power * r ** (power - 5) / (8 * np.pi**2 / 3), 0.0)


def rare_event() -> MixtureProblem:
    """Whether x_1 >= 5.5 or x_2 >= 5.7, for x standard normal in 5 dimensions; two good proposals and eight bad ones.

    Returns
    -------
    MixtureProblem
        Of mean 2.49799338e-8, with 11 proposals.

    Examples
    --------
    >>> from evenlight.lab import rare_event
    >>> float(f"{rare_event().exact:.9g}")
    2.49799338e-08
    """
    target = Normal(np.zeros(5))
    axes = np.eye(5)
    guesses = [-axes[0], -axes[1], axes[2], -axes[2], axes[3], -axes[3], axes[4], -axes[4]]
    first, second = float(special.ndtr(-5.5)), float(special.ndtr(-5.7))
    exact = first + second - first * second

    def locate(u: Array) -> tuple[Array, Array]:
        """Points of the event, and its probability over the density there: x_1 >= 5.5, or else only x_2 >= 5.7."""
        x = special.ndtri(np.clip(u[:, 1:], 2.0**-65, None))
        by_first = u[:, 0] < first / exact
        below = (1 - first) * np.clip(u[:, 1], 2.0**-65, None)
        x[:, 0] = np.where(by_first, -special.ndtri(first * (1 - u[:, 1])), special.ndtri(below))
        x[:, 1] = np.where(by_first, x[:, 1], -special.ndtri(second * (1 - u[:, 2])))
        return x, exact / np.exp(target.logpdf(x))

    return MixtureProblem(
        f=lambda x: ((x[:, 0] >= 5.5) | (x[:, 1] >= 5.7)).astype(np.float64),
        target=target,
        proposals=(
            Normal([5.2, 0.4, -0.3, 0, 0]),
            Normal([-0.3, 5.9, 0, 0.3, 0]),
            *(Normal(5.5 * guess) for guess in guesses),
            target,
        ),
        exact=exact,
        locate=locate,
        uniforms=6,
    )
