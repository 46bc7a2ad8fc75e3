"""VEGAS: importance sampling from a grid that adapts to an integrand, through the package of that name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, SupportsIndex

import numpy as np

from evenlight.arguments import integer, seed_number
from evenlight.estimate import Estimate, from_error, from_moments, plain
from evenlight.integrand import Integrand
from evenlight.moments import Moments

__all__ = ["vegas_estimate"]


def vegas_estimate(
    f: Callable[[Any], Any],
    domain: Any,
    *,
    n: SupportsIndex = 2**16,
    iterations: SupportsIndex = 10,
    learn: float = 0.5,
    combine: Literal["equal", "inverse-variance"] = "equal",
    seed: SupportsIndex = 0,
    **settings: Any,
) -> Estimate:
    """Integrate by VEGAS+, for comparison: a product of step densities, and strata with points where they are needed.

    Choose it where nothing is known of f but that its peaks lie along the axes; `adaptive_estimate` where they do not.

    Parameters
    ----------
    f : callable
        From points, shape (m, d), to values, shape (m,) or (m, ...); of several the grid adapts to the first.
    domain : int or domain
        Dimensions of the unit cube, or what maps it to where f lives: see `integrate`.
    n : int
        Function values in all; the package takes up to a tenth less, as its strata have it.
    iterations : int
        Independent runs over the grid that make the estimate, at least 2.
    learn : float
        The share of n to adapt the grid with, from 0 on and below 1.
    combine : {"equal", "inverse-variance"}
        "equal": the grid stands still after learning, and all iterations count alike: no bias, and honest intervals
        from their spread. "inverse-variance": the grid adapts all the time (`learn` has no effect), and iterations
        count by the variance each claims. That is what the package does by default. An iteration that missed a peak
        claims a small variance, so that the result is biased and its intervals, claimed to be 95 %, hold the truth
        less often.
    seed : int
        Same seed, same bits.
    **settings
        Of `vegas.Integrator`: ``alpha`` damps the grid, ``beta=0`` is the classic algorithm without adaptive strata.

    Returns
    -------
    Estimate
        With the `replicates`, which are the iterations, or the package's quality of fit `Q` among the diagnostics.

    Raises
    ------
    ImportError
        If the package is not installed.
    ValueError
        If an argument is not as above.

    Notes
    -----
    G. P. Lepage, J. Comput. Phys. 27, 192-203 (1978) and 439, 110386 (2021).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.importance import vegas_estimate
    >>> estimate = vegas_estimate(lambda x: np.exp(-100 * ((x - 0.5) ** 2).sum(axis=1)), 3, n=20_000)
    >>> bool(abs(estimate.value / 5.568327996831e-3 - 1) < 0.02)
    True
    """
    rounds = integer("iterations", iterations, 2)
    if not 0 <= learn < 1:
        raise ValueError(f"learn must be from 0 on and below 1, not {learn}")
    if combine not in ("equal", "inverse-variance"):
        raise ValueError(f"combine must be 'equal' or 'inverse-variance', not {combine!r}")
    run = _Run(f, domain, seed, settings)
    total = integer("n", n, 2 * rounds)
    if combine == "inverse-variance":
        return run.weighted(total // rounds, rounds)
    spent = round(total * learn) if learn else 0
    if spent:
        run.integrate(max(2, spent // rounds), rounds, adapt=True)
    return run.equal((total - spent) // rounds, rounds)


class _Run:
    """An integrator of the package, driven by a seed, with its function values counted."""

    def __init__(self, f: Callable[[Any], Any], domain: Any, seed: SupportsIndex, settings: dict[str, Any]) -> None:
        try:
            import vegas
        except ImportError:
            raise ImportError("vegas_estimate needs the package vegas: pip install evenlight[vegas]") from None
        whole = None if hasattr(domain, "map") else integer("domain", domain, 1)
        self._values = Integrand(f, None if whole else domain, "raise")
        self._count = 0
        self._integrand = vegas.lbatchintegrand(self._at)
        draw = np.random.default_rng(seed_number(seed)).random
        box = [[0.0, 1.0]] * (whole or domain.d)
        self._integrator = vegas.Integrator(box, ran_array_generator=draw, **settings)

    def _at(self, u: Any) -> Any:
        values, _ = self._values(np.ascontiguousarray(u), self._count)
        self._count += len(u)
        return values

    def integrate(self, size: int, rounds: int, *, adapt: bool) -> Any:
        """One call of the package: values of about `size` points in each of several iterations."""
        return self._integrator(self._integrand, nitn=rounds, neval=size, adapt=adapt)

    def equal(self, size: int, rounds: int) -> Estimate:
        """The mean over iterations with the grid as it is, and its error from their spread."""
        before = self._count
        result = self.integrate(size, rounds, adapt=False)
        means = np.array([_means(each) for each in result.itn_results])
        return from_moments(
            (((self._count - before) / rounds, Moments.of(means)),),
            method="vegas",
            cost=float(self._count),
            message="as many function values as asked",
            diagnostics={"replicates": means},
        )

    def weighted(self, size: int, rounds: int) -> Estimate:
        """The average of the package, and the error it claims."""
        result = self.integrate(size, rounds, adapt=True)
        estimate = Estimate(
            value=plain(_means(result)),
            standard_error=plain(_errors(result)),
            n=self._count,
            replicates=rounds,
            cost=float(self._count),
            method="vegas (inverse variance)",
            message="as many function values as asked",
            diagnostics={"Q": float(result.Q)},
            degrees_of_freedom=float(self._count - 1),
        )
        return from_error(estimate)


def _means(result: Any) -> Any:
    import gvar

    return gvar.mean(np.asarray(result) if np.ndim(result) else result)


def _errors(result: Any) -> Any:
    import gvar

    return gvar.sdev(np.asarray(result) if np.ndim(result) else result)
