"""Rules: how function values at points become an estimate. One rule, one file; `RULES` lists them."""

from evenlight.rules.mc import MonteCarlo
from evenlight.rules.median import Median
from evenlight.rules.protocol import Rule
from evenlight.rules.qmc import QuasiMonteCarlo
from evenlight.rules.rqmc import RandomizedQuasiMonteCarlo

__all__ = ["RULES", "Median", "MonteCarlo", "QuasiMonteCarlo", "RandomizedQuasiMonteCarlo", "Rule", "choose"]

RULES: dict[str, type[Rule]] = {
    rule.name: rule for rule in (MonteCarlo, QuasiMonteCarlo, RandomizedQuasiMonteCarlo, Median)
}
"""The rules by their names."""

_INDEPENDENT = frozenset({"independent", "philox", "pcg", "mersenne_twister"})


def choose(method: str, points: object) -> type[Rule]:
    """Return the rule of that name, or for "auto" the one that fits the points.

    Examples
    --------
    >>> from evenlight.points import Independent, Sobol
    >>> from evenlight.rules import choose
    >>> [choose("auto", points).name for points in (Independent(2), Sobol(2), Sobol(2, scramble="none"))]
    ['mc', 'rqmc', 'qmc']
    """
    independent = getattr(points, "sequence", "") in _INDEPENDENT
    if method == "auto":
        if independent:
            return MonteCarlo
        return RandomizedQuasiMonteCarlo if getattr(points, "is_random", True) else QuasiMonteCarlo
    if method not in RULES:
        raise ValueError(f"unknown method {method!r}; known: auto, {', '.join(RULES)}")
    if method == "mc" and not independent:
        raise ValueError(f"method 'mc' takes its error from independent points, which {points!r} are not; use 'rqmc'")
    return RULES[method]
