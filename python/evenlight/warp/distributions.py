"""Distributions: normal, tabulated, discrete, images, and any frozen one of SciPy."""

from typing import Any, ClassVar

import numpy as np

from .arguments import real_array
from .base import Warp

__all__ = [
    "Discrete",
    "DiscreteAlias",
    "Frozen",
    "Gaussian",
    "Image",
    "PiecewiseConstant",
    "PiecewiseLinear",
]


class Gaussian(Warp):
    """The interval to the standard normal distribution by its inverse, to the last digits of a double.

    Numbers stand for intervals of 2^-53, of which the middle is taken, so that 0 does not become minus infinity.

    Notes
    -----
    References: M. J. Wichura, *Algorithm AS 241: the percentage points of the normal distribution*, Appl. Statist.
    37(3), 477-484 (1988).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Gaussian().map([[0.975], [0.0]]).round(4)
    array([[ 1.96  ],
           [-8.2924]])
    """

    warp = "gaussian"


class _Tabulated(Warp):
    def __init__(self, values: Any, knots: Any = None) -> None:
        super().__init__(
            values=real_array("values", values, (None,)).tolist(),
            knots=None if knots is None else real_array("knots", knots, (None,)).tolist(),
        )


class PiecewiseLinear(_Tabulated):
    """The interval to a density that is linear between knots, by inversion: any tabulated function of one variable.

    Parameters
    ----------
    values : array_like, shape (n,)
        Densities at the knots, up to a factor: at least two, none negative, not all 0.
    knots : array_like, shape (n,), optional
        Ascending; evenly over [0, 1] by default.

    Examples
    --------
    >>> from evenlight import warp
    >>> ramp = warp.PiecewiseLinear([0.0, 1.0])
    >>> ramp.map([[0.25]]), ramp.density([[0.5]])
    (array([[0.5]]), array([1.]))
    """

    warp = "piecewise_linear"


class PiecewiseConstant(_Tabulated):
    """The interval to a histogram, by inversion.

    Parameters
    ----------
    values : array_like, shape (n,)
        Densities between the knots, up to a factor: none negative, not all 0.
    knots : array_like, shape (n + 1,), optional
        Ascending; evenly over [0, 1] by default.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.PiecewiseConstant([1.0, 3.0]).map([[0.25], [0.625]])
    array([[0.5 ],
           [0.75]])
    """

    warp = "piecewise_constant"


class Discrete(Warp):
    """The interval to numbered choices, by inversion: points are (choice, what is left of the number).

    The rest is uniform in [0, 1) again, for what follows. Monotone, so that well-spread points stay well spread.

    Parameters
    ----------
    values : array_like, shape (n,)
        Weights, up to a factor: none negative, not all 0.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Discrete([1.0, 0.0, 3.0]).map([[0.125], [0.625]])
    array([[0. , 0.5],
           [2. , 0.5]])
    """

    warp = "discrete"

    def __init__(self, values: Any) -> None:
        super().__init__(values=real_array("values", values, (None,)).tolist())


class DiscreteAlias(Warp):
    """The interval to numbered choices, by an alias table: the same cost for any number of them, but strata are torn.

    Parameters
    ----------
    values : array_like, shape (n,)
        Weights, up to a factor: none negative, not all 0.

    Notes
    -----
    References: M. D. Vose, *A linear algorithm for generating random numbers with a given distribution*,
    IEEE Trans. Softw. Eng. 17(9), 972-975 (1991).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.DiscreteAlias([1.0, 3.0]).map([[0.125], [0.375], [0.75]])
    array([[0. , 0.5],
           [1. , 0.5],
           [1. , 0.5]])
    """

    warp = "discrete_alias"

    def __init__(self, values: Any) -> None:
        super().__init__(values=real_array("values", values, (None,)).tolist())


class Image(Warp):
    """The square to an image as a density on the square: a row, a pixel of it, a place in the pixel.

    Parameters
    ----------
    values : array_like, shape (height, width)
        Densities, up to a factor: none negative, not all 0. For a map of directions by latitude, multiply the rows by
        the sine of their distance from the pole.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Image([[0.0, 1.0], [0.0, 0.0]]).map([[0.5, 0.5]])  # x along rows, y down columns
    array([[0.75, 0.25]])
    """

    warp = "image"

    def __init__(self, values: Any) -> None:
        image = real_array("values", values, (None, None))
        super().__init__(values=image.ravel().tolist(), columns=image.shape[1])

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the image."""
        return Image, (np.reshape(self._options["values"], (-1, self._options["columns"])),)


class Frozen:
    """The cube to independent frozen distributions of `scipy.stats`, by their quantile functions.

    Parameters
    ----------
    *distributions
        Continuous or discrete, one for each coordinate.

    Notes
    -----
    Numbers stand for intervals of 2^-53, of which the middle is taken. Where a distribution is discrete, `invert` gives
    the upper end of what leads to a point. As precise and as fast as SciPy's `ppf`, `cdf`, and `pdf` or `pmf`.

    Examples
    --------
    >>> from scipy import stats
    >>> from evenlight import warp
    >>> both = warp.Frozen(stats.expon(scale=2.0), stats.norm())
    >>> both.map([[0.5, 0.975]]).round(3)
    array([[1.386, 1.96 ]])
    >>> both.invert(both.map([[0.5, 0.975]])).round(12)
    array([[0.5  , 0.975]])
    """

    warp: ClassVar[str] = "frozen"

    def __init__(self, *distributions: Any) -> None:
        if not distributions:
            raise ValueError("give at least one frozen distribution")
        for distribution in distributions:
            if not (hasattr(distribution, "ppf") and hasattr(distribution, "cdf")):
                raise TypeError(f"a frozen distribution of scipy.stats is needed, not {type(distribution).__name__}")
        self._distributions = distributions

    @property
    def inputs(self) -> int:
        """How many uniform numbers make a point."""
        return len(self._distributions)

    @property
    def outputs(self) -> int:
        """How many coordinates a point has."""
        return len(self._distributions)

    def map(self, u: Any) -> Any:
        """Points of uniform numbers: see `Warp.map`.

        Parameters
        ----------
        u : array_like, shape (..., inputs)
            Numbers in [0, 1).

        Returns
        -------
        array of float64, shape (..., inputs)

        Raises
        ------
        ValueError
            If `u` has another last axis, or a number outside [0, 1).
        """
        numbers = self._columns("u", u)
        if numbers.size and not (numbers.min() >= 0 and numbers.max() < 1):
            raise ValueError(f"u must be in [0, 1), not from {numbers.min()} to {numbers.max()}")
        # near 1, where 2^-54 is half of the last digit, the sum must not become 1
        return self._each("ppf", np.minimum(numbers + 2.0**-54, 1 - 2.0**-53))

    def density(self, x: Any) -> Any:
        """The density of mapped uniform numbers, or their probability where a distribution is discrete.

        Parameters
        ----------
        x : array_like, shape (..., inputs)
            Points.

        Returns
        -------
        array of float64, shape (...)

        Raises
        ------
        ValueError
            If `x` has another last axis.
        """
        points = self._columns("x", x)
        factors = [
            (distribution.pdf if hasattr(distribution, "pdf") else distribution.pmf)(points[..., column])
            for column, distribution in enumerate(self._distributions)
        ]
        return np.prod(factors, axis=0)

    def invert(self, x: Any) -> Any:
        """The uniform numbers that lead to points: see `Warp.invert`.

        Parameters
        ----------
        x : array_like, shape (..., inputs)
            Points.

        Returns
        -------
        array of float64, shape (..., inputs)

        Raises
        ------
        ValueError
            If `x` has another last axis.
        """
        return self._each("cdf", self._columns("x", x))

    def __repr__(self) -> str:
        """Return how many distributions there are."""
        return f"Frozen({', '.join(distribution.dist.name for distribution in self._distributions)})"

    def _columns(self, name: str, values: Any) -> Any:
        array = np.asarray(values, dtype=np.float64)
        if array.ndim == 0 or array.shape[-1] != self.inputs:
            raise ValueError(f"{name} must have {self.inputs} numbers in its last axis, not shape {array.shape}")
        return array

    def _each(self, method: str, array: Any) -> Any:
        columns = [
            getattr(distribution, method)(array[..., column]) for column, distribution in enumerate(self._distributions)
        ]
        return np.stack(columns, axis=-1)
