"""Points that nothing can be left of without their randomness."""

from typing import Any, SupportsIndex

from .engine import Engine, SeedLike

__all__ = ["AlwaysRandom", "Design"]


class AlwaysRandom(Engine):
    """Points with a seed but no scramble; the subclasses say which.

    Parameters
    ----------
    d : int
        The number of coordinates of a point.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.
    **arguments
        The options of the sequence, and `optimization` as in `Engine`.

    Raises
    ------
    TypeError, ValueError
        If an argument has the wrong type or no meaning; the message says what is allowed.
    """

    def __init__(self, d: SupportsIndex, *, seed: SeedLike = None, rng: SeedLike = None, **arguments: Any) -> None:
        super().__init__(d, **{"scramble": "none", "seed": seed, "rng": rng, **arguments})

    @property
    def is_random(self) -> bool:
        """Whether the seed matters: always."""
        return True

    def _spec(self) -> dict[str, Any]:
        return {"d": self.d, **self._options}


class Design(AlwaysRandom):
    """A set of n random points that are good together; the subclasses say which.

    Parameters
    ----------
    d : int
        The number of coordinates of a point.
    n : int, optional
        The number of points. If it is not given, the first call of `random` says it.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.
    **arguments
        Further options of the design, and `optimization` as in `Engine`.

    Raises
    ------
    TypeError, ValueError
        If an argument has the wrong type or no meaning; the message says what is allowed.
    """

    finite = True

    def __init__(
        self,
        d: SupportsIndex,
        *,
        n: SupportsIndex | None = None,
        seed: SeedLike = None,
        rng: SeedLike = None,
        **arguments: Any,
    ) -> None:
        super().__init__(d, **{"n": n, "seed": seed, "rng": rng, **arguments})
