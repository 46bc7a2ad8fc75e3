"""Points in groups of fixed sizes: means and errors that leave out what the means of the groups differ by."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from evenlight.importance.densities.density import Array

__all__ = ["Strata"]


class Strata(NamedTuple):
    """The points of every stratum: how many, their means, and the squares of their deviations from these."""

    numbers: Any
    """Shape (J,)."""
    means: Array
    """Shape (J, k)."""
    squares: Array
    """Sums, shape (J, k)."""

    @classmethod
    def of(cls, y: Array, stratum: Any, strata: int) -> Strata:
        """From values, shape (n, k), and the number of the stratum of each, shape (n,).

        A stratum with one point has no spread of its own: it is judged by its distance from the mean of all.
        """
        numbers = np.bincount(stratum, minlength=strata)
        means = _sums(y, stratum, strata) / np.maximum(numbers, 1)[:, np.newaxis]
        centers = np.where(numbers[:, np.newaxis] > 1, means, y.mean(axis=0))
        return cls(numbers, means, _sums((y - centers[stratum]) ** 2, stratum, strata))

    def error(self, shares: Any) -> tuple[Array, float]:
        """The standard error of the sum of shares times means, shape (k,), and its degrees of freedom, the least of k.

        The degrees are those of F. E. Satterthwaite, Biometrics Bull. 2(6), 110-114 (1946).
        """
        less_one = np.maximum(self.numbers - 1, 1)[:, np.newaxis]
        scales = np.asarray(shares)[:, np.newaxis] ** 2 / np.maximum(self.numbers, 1)[:, np.newaxis]
        variances = scales * self.squares / less_one
        total = variances.sum(axis=0)
        moving = total > 0
        most = float(self.numbers.sum() - len(self.numbers))
        degrees = total[moving] ** 2 / (variances[:, moving] ** 2 / less_one).sum(axis=0)
        return np.sqrt(total), max(1.0, float(degrees.min(initial=max(most, 1.0))))


def _sums(y: Array, stratum: Any, strata: int) -> Array:
    return np.stack([np.bincount(stratum, column, minlength=strata) for column in y.T], axis=1)
