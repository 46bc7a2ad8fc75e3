"""Densities to draw from: ours, and SciPy's and users' behind the same two functions. One density, one file."""

from typing import Any

from .callables import Callables
from .density import Density
from .normal import Normal
from .student_t import StudentT
from .univariate import Univariate

__all__ = ["DENSITIES", "Callables", "Density", "Normal", "StudentT", "Univariate", "as_density"]

DENSITIES: dict[str, type[Density]] = {density.name: density for density in (Normal, StudentT, Univariate, Callables)}
"""The classes by their names; each says by `adopt` which foreign objects it stands for."""


def as_density(thing: Any) -> Density:
    """Return a density as the package needs it.

    Parameters
    ----------
    thing : object
        A density of ours, anything with `d`, `sample(u)` and `logpdf(x)`, a frozen `scipy.stats.multivariate_normal`
        or `multivariate_t`, or a frozen or new-style continuous distribution of SciPy, which has one dimension.

    Returns
    -------
    Density
        With `d`, `uniforms`, `sample(u)` and `logpdf(x)`.

    Raises
    ------
    TypeError
        If it is none of these.

    Examples
    --------
    >>> from scipy import stats
    >>> from evenlight.importance import as_density
    >>> as_density(stats.multivariate_normal([0, 1], [[2, 0], [0, 1]])).d
    2
    """
    for density in DENSITIES.values():
        adopted = density.adopt(thing)
        if adopted is not None:
            return adopted
    raise TypeError(
        f"{thing!r} is no density: it needs d, sample(u) and logpdf(x), or to be a frozen distribution of scipy.stats"
    )
