"""What a run of chains leaves: positions, what the kernel told, and estimates with honest errors."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from evenlight.estimate import Estimate, from_moments
from evenlight.moments import Moments

from .diagnostics import Diagnostics, diagnose, disagreement, divergence, split_r_hat
from .driving import Driving
from .kernel import Array

__all__ = ["Chains", "values_at"]


@dataclass(frozen=True, eq=False, repr=False)
class Chains:
    """Chains of one run.

    Attributes
    ----------
    draws : ndarray of float64, shape (chains, n, d), or None
        The position after each step that counts; None if they were not kept.
    info : dict
        What the kernel told, by name: arrays (chains, n, ...).
    sums : dict
        Of the functionals over the steps of each chain, shape (chains, ...).
    kernel : Kernel
        With the settings that a warm-up has left.
    points : Driving
        What drove the chains.
    state : State
        At the end.
    seed : int
        Of the run.
    steps_before : tuple of int
        Steps of warm-up and of burn-in.
    given : Kernel
        As it was before the warm-up.

    Examples
    --------
    >>> from evenlight.mcmc import RandomWalk, run
    >>> chains = run(RandomWalk(lambda x: -0.5 * (x**2).sum(axis=1)), [0.0, 0.0], n=100, chains=8, seed=1)
    >>> chains.draws.shape, chains.acceptance.shape, chains.estimate(lambda x: x).value.shape
    ((8, 100, 2), (8,), (2,))
    """

    draws: Array | None
    info: dict[str, Any]
    sums: dict[str, Array]
    kernel: Any
    points: Driving
    state: Any
    seed: int
    steps_before: tuple[int, int]
    given: Any

    def __repr__(self) -> str:
        """Show what ran; `diagnostics()` shows how it went."""
        count, d = self.state.position.shape
        return (
            f"Chains({count} of {self.n} steps in {d} dimensions, {self.kernel.name} driven by {self.points.name}, "
            f"seed={self.seed}, mean acceptance {self.acceptance.mean():.2f})"
        )

    @property
    def n(self) -> int:
        """The steps that count, of each chain."""
        return int(self.info["acceptance"].shape[1])

    @property
    def means(self) -> dict[str, Array]:
        """Means of the functionals over each chain, shape (chains, ...)."""
        return {name: total / self.n for name, total in self.sums.items()}

    @property
    def acceptance(self) -> Array:
        """The mean probability of acceptance of each chain."""
        return np.asarray(self.info["acceptance"].mean(axis=1))

    @property
    def divergences(self) -> int:
        """How many trajectories diverged, where the kernel tells: with HMC and NUTS."""
        return int(np.sum(self.info.get("diverging", 0)))

    def estimate(self, functional: str | Callable[[Any], Any]) -> Estimate:
        """The mean of a function under the target, with a standard error from independent repetitions.

        Independent numbers: every chain is a repetition. Driving sequences: every randomization is, with all chains
        that it couples. The error says how much the run varies, not what all chains share: too short a burn-in, or a
        mode that none of them has found.

        Parameters
        ----------
        functional : callable or str
            From positions (m, d) to values (m,) or (m, ...), or the name of one that was given to `run`.

        Returns
        -------
        Estimate
            NaN as the standard error of a single repetition, and of chains that are not random. `converged` is False,
            and `message` says why, if the chains disagree about the function (split R-hat above 1.01; not known of a
            functional by name) or trajectories diverged. `diagnostics` has the means of the repetitions.

        Raises
        ------
        ValueError
            If there is no such functional, the draws were not kept, or a value is not finite.
        """
        means, r_hat = self._chain_means(functional)
        doubts = [*filter(None, [disagreement(r_hat), divergence(self.divergences)])]
        together = self.points.coupled if self.kernel.random else len(means)
        groups = means.reshape(-1, together, *means.shape[1:]).mean(axis=1)
        size = self.n * together
        return from_moments(
            ((float(size), Moments.of(groups)),),
            method=f"{self.kernel.name} driven by {self.points.name}",
            cost=float(len(means) * (self.n + sum(self.steps_before))),
            converged=not doubts,
            message="; ".join(doubts),
            diagnostics={"replicates": groups, "points": (f"chains of seed {self.seed}",)},
        )

    def diagnostics(self, functional: Callable[[Any], Any] | None = None) -> Diagnostics:
        """Whether the chains agree, what their draws are worth, and what speaks against trusting them, by ArviZ.

        Effective sample sizes and Monte Carlo errors presume chains and steps that are independent, but for what a
        kernel remembers: they are NaN for runs that a driving sequence has driven; `estimate` has errors there.

        Parameters
        ----------
        functional : callable, optional
            From positions (m, d) to values (m,) or (m, k); the positions themselves by default.

        Returns
        -------
        Diagnostics
            For each of the d dimensions, or k values.

        Raises
        ------
        ValueError
            If the draws were not kept, or a value is not finite.
        """
        values = values_at(functional or (lambda x: x), self.kept_draws())
        independent = self.kernel.random and self.points.independent_steps and self.points.coupled == 1
        return diagnose(values.reshape(*values.shape[:2], -1), self.acceptance, independent, self.divergences)

    def to_arviz(self, variables: Mapping[str, Callable[[Any], Any]] | None = None) -> Any:
        """Convert to what ArviZ plots and summarizes: groups `posterior` and `sample_stats`.

        Parameters
        ----------
        variables : mapping of str to callable, optional
            What `posterior` is to have: functions from positions (m, d) to values (m,) or (m, ...). By default the
            positions, as `x`.

        Returns
        -------
        xarray.DataTree
            ArviZ's InferenceData, from its version 1 on.

        Raises
        ------
        ImportError
            If arviz-base is not installed.
        ValueError
            If the draws were not kept, or a value is not finite.
        """
        try:
            import arviz_base
        except ImportError:
            raise ImportError("to_arviz needs arviz-base: pip install 'evenlight[arviz]'") from None
        names = {"acceptance": "acceptance_rate", "gradients": "n_steps"}
        told = {names.get(name, name): column for name, column in self.info.items()}
        draws = self.kept_draws()
        shown = {name: values_at(function, draws) for name, function in (variables or {"x": lambda x: x}).items()}
        tree = arviz_base.from_dict({"posterior": shown, "sample_stats": told})
        tree.attrs.update(kernel=self.kernel.name, driven_by=repr(self.points), seed=str(self.seed))
        return tree

    def kept_draws(self) -> Array:
        """The draws, or a ValueError if they were not kept."""
        if self.draws is None:
            raise ValueError("this run kept no draws: name its functionals, or run with keep_draws=True")
        return self.draws

    def _chain_means(self, functional: str | Callable[[Any], Any]) -> tuple[Array, Array]:
        """The mean over each chain, and R-hat of every entry, NaN where it says nothing."""
        if isinstance(functional, str):
            if functional not in self.means:
                raise ValueError(f"no functional {functional!r} in this run; known: {', '.join(self.means) or 'none'}")
            return self.means[functional], np.full(1, np.nan)
        values = values_at(functional, self.kept_draws())
        r_hat = split_r_hat(values.reshape(*values.shape[:2], -1)) if self.kernel.random else np.full(1, np.nan)
        return np.asarray(values.mean(axis=1)), r_hat


def values_at(function: Callable[[Any], Any], points: Array) -> Array:
    """The values of a function of rows at points of shape (chains, n, d), shape (chains, n, ...)."""
    rows = points.reshape(-1, points.shape[2])
    values = np.asarray(function(rows), np.float64)
    if values.shape[:1] != (len(rows),):
        raise ValueError(f"the function must return an array of shape ({len(rows)}, ...), not {values.shape}")
    if not np.isfinite(values).all():
        row = int(np.argmin(np.isfinite(values).reshape(len(rows), -1).all(axis=1)))
        raise ValueError(f"the function is {values[row].tolist()} at {rows[row].tolist()}")
    return np.asarray(values.reshape(*points.shape[:2], *values.shape[1:]))
