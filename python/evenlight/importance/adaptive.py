"""Adaptive mixtures: components and weights learned over several rounds, for integrands nobody has proposals for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, SupportsIndex

from evenlight.estimate import Estimate, from_error
from evenlight.importance.densities import Density
from evenlight.importance.densities.density import Array
from evenlight.importance.learning import Learning
from evenlight.importance.mixture import Mixture
from evenlight.importance.mixture_estimate import mixture_estimate
from evenlight.integrand import Integrand
from evenlight.points import Independent

__all__ = ["LearnedMixture", "adaptive_estimate", "learn_mixture"]


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
        From points, shape (m, d), to values, shape (m,) or (m, ...). For several values the variance is the sum of
        theirs, each over its squared mean of |f|.
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
    learning = Learning(Integrand(f, None, "raise"), start, aim)
    source = Independent(start.uniforms, seed=seed)
    for number in range(rounds):
        learning.look(source.replicate(number), n // rounds + (number < n % rounds))
        if aim == "weights":
            learning.reweigh(floor)
        else:
            learning.fit()
    components, alpha, gap = learning.learned(floor)
    return LearnedMixture(tuple(components), alpha, gap, n)


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
