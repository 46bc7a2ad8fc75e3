"""The No-U-Turn Sampler of nuts-rs, by way of nutpie: HMC that finds its own length. An optional extra."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, ClassVar, SupportsIndex

import numpy as np

from evenlight.arguments import SeedLike, check_callable, integer, seed_number

from .chains import Chains
from .driving import IndependentNumbers
from .gradients import Gradient, with_gradient
from .kernel import Array, LogDensity, State
from .leapfrog import gradient_state
from .target import check_between_0_and_1

__all__ = ["NUTS"]


class _OutsideError(ValueError):
    """The trajectory left the target: it ends there."""

    is_recoverable = True  # what nuts-rs asks an error for


@dataclass(frozen=True, eq=False)
class NUTS:
    """The No-U-Turn Sampler [1]_ with adaptation of step size and diagonal mass matrix [2]_.

    It has no `step` of ours: the library runs the chains, with random numbers of its own, one value and gradient at a
    time. Choose it over `HMC` when no number of steps suits, and over that in a loop when the target is expensive.
    Funnels need other coordinates, whatever the target acceptance: see `HMC`.

    Parameters
    ----------
    log_density : callable
        From positions (m, d) to logarithms of the unnormalized target (m,).
    gradient : callable or {"finite-differences", "jax", "torch"}
        From positions (m, d) to gradients of the log density (m, d), or how to get them.
    target_acceptance : float
        Between 0 and 1; higher for targets with narrow places.
    max_depth : int
        Trajectories have at most 2^max_depth - 1 steps.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    References
    ----------
    .. [1] M. D. Hoffman and A. Gelman, "The No-U-Turn sampler: adaptively setting path lengths in Hamiltonian Monte
       Carlo", J. Mach. Learn. Res. 15, 1593-1623 (2014).
    .. [2] nutpie and nuts-rs (MIT License), of the developers of PyMC: https://pymc-devs.github.io/nutpie

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.mcmc import NUTS
    >>> sampler = NUTS(lambda x: -0.5 * (x**2).sum(axis=1), lambda x: -x)
    >>> chains = sampler.run(np.ones(3), n=300, chains=4, warm_up=200, seed=1)
    >>> chains.draws.shape, bool(chains.diagnostics().r_hat.max() < 1.05)
    ((4, 300, 3), True)
    """

    name: ClassVar[str] = "nuts"
    random: ClassVar[bool] = True

    log_density: LogDensity
    gradient: Gradient
    target_acceptance: float = 0.8
    max_depth: int = 10
    _functions: tuple[LogDensity, Callable[[Array], Array]] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        check_callable("log_density", self.log_density)
        check_between_0_and_1("target_acceptance", self.target_acceptance)
        integer("max_depth", self.max_depth, 1)
        object.__setattr__(self, "_functions", with_gradient(self.log_density, self.gradient))

    def run(
        self,
        start: Any,
        *,
        n: SupportsIndex,
        chains: SupportsIndex = 4,
        warm_up: SupportsIndex = 500,
        seed: SeedLike = None,
    ) -> Chains:
        """Run chains.

        Parameters
        ----------
        start : array_like, shape (d,) or (m, d)
            Where chains start: each at one of the rows, chosen at random. Coordinates in which the gradient is 0, which
            the library refuses, are moved a little.
        n : int
            The steps of each chain that count.
        chains : int
            How many.
        warm_up : int
            Steps before, in which step size and mass matrix are found.
        seed : int or numpy.random.Generator, optional
            The same number gives the same bits; 0 by default.

        Returns
        -------
        Chains
            As from `evenlight.mcmc.run`. Its `info` has `acceptance`, `accepted`, `energy_error`, `gradients`, `depth`
            and `diverging` of each step.

        Raises
        ------
        ImportError
            If nutpie is not installed.
        TypeError, ValueError
            If an argument is not as above, or the target is 0 at a start.
        """
        library, build = _library()
        steps, count, tune = integer("n", n, 1), integer("chains", chains, 1), integer("warm_up", warm_up, 1)
        number = seed_number(seed)
        starts = self._starts(start, number)
        model = build(
            starts.shape[1],
            lambda: self._value_and_gradient,
            lambda *_: lambda x: {"x": np.array(x)},
            expanded_names=["x"],
            expanded_dtypes=[np.dtype(np.float64)],
            expanded_shapes=[(starts.shape[1],)],
            make_initial_point_fn=lambda own: starts[own % len(starts)].copy(),
        )
        trace = library.sample(
            model,
            draws=steps,
            tune=tune,
            chains=count,
            cores=1,  # Python's lock lets only one chain run anyway
            seed=number % 2**63,
            progress_bar=False,
            save_warmup=False,
            target_accept=self.target_acceptance,
            maxdepth=self.max_depth,
        )
        draws = np.array(trace.posterior["x"].values, np.float64)
        return Chains(
            draws=draws,
            info=_info(trace.sample_stats),
            sums={},
            kernel=self,
            points=IndependentNumbers(),
            state=State(draws[:, -1]),
            seed=number,
            steps_before=(tune, 0),
            given=self,
        )

    def _starts(self, start: Any, seed: int) -> Array:
        rows = np.atleast_2d(np.asarray(start, np.float64))
        state = gradient_state(*self._functions, rows)
        noise = np.random.default_rng(seed).normal(size=rows.shape)
        return np.where(state.gradient == 0, rows + 0.01 * noise * np.maximum(1.0, np.abs(rows)), rows)

    def _value_and_gradient(self, x: Array) -> tuple[float, Array]:
        log_density, gradient = self._functions
        value = float(np.asarray(log_density(x[None]), np.float64)[0])
        slopes = gradient(x[None])[0]
        if not (np.isfinite(value) and np.isfinite(slopes).all()):
            raise _OutsideError(f"log_density is {value}, its gradient {slopes.tolist()} at {x.tolist()}")
        return value, slopes


def _library() -> tuple[Any, Any]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FutureWarning)  # of ArviZ, about its own future
            import nutpie
            from nutpie.compiled_pyfunc import from_pyfunc
    except ImportError:
        raise ImportError("NUTS needs nutpie: pip install 'evenlight[nuts]'") from None
    return nutpie, from_pyfunc


def _info(statistics: Any) -> dict[str, Any]:
    """The library's statistics under the names that our kernels use."""
    acceptance = np.asarray(statistics["mean_tree_accept"].values, np.float64)
    return {
        "acceptance": acceptance,
        "accepted": np.asarray(statistics["index_in_trajectory"].values != 0),
        "energy_error": np.asarray(statistics["energy_error"].values, np.float64),
        "gradients": np.asarray(statistics["n_steps"].values, np.float64),
        "depth": np.asarray(statistics["depth"].values, np.int64),
        "diverging": np.asarray(statistics["diverging"].values, bool),
    }
