"""What all warps share: a map of uniform numbers with its density and its inverse, on arrays."""

from typing import Any, ClassVar, SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core
from evenlight.arguments import threads

__all__ = ["Warp"]

Numbers = npt.NDArray[np.float64] | npt.NDArray[np.float32]


class Warp:
    """A map of uniform numbers to points of known density; the subclasses say which.

    Arrays of float32 stay in single precision; everything else is computed in double. `density` is 0 where the warp
    does not lead; `invert` undoes `map`, and where the warp folds the cube it gives one of the places that lead to a
    point.

    Parameters
    ----------
    **options
        What the warp asks, in plain values; None leaves the choice to the warp.
    """

    warp: ClassVar[str]
    """The name in the registry."""

    def __init__(self, **options: Any) -> None:
        self._options = {name: value for name, value in options.items() if value is not None}
        known = next(options for name, _, options, _ in _core.available_warps() if name == self.warp)
        for option in self._options:
            if option not in known:
                has = ", ".join(known) or "none"
                raise TypeError(f"{type(self).__name__} has no option {option!r}; it has: {has}")
        self._core = _core.Warp(self.warp, **self._options)

    @property
    def inputs(self) -> int:
        """How many uniform numbers make a point."""
        return self._core.inputs

    @property
    def outputs(self) -> int:
        """How many coordinates a point has."""
        return self._core.outputs

    def map(self, u: Any, *, workers: SupportsIndex = 1) -> Any:
        """Points of uniform numbers.

        Parameters
        ----------
        u : array_like, shape (..., inputs)
            Numbers in [0, 1).
        workers : int, optional
            The most threads to use, -1 for all processors. The numbers do not depend on it.

        Returns
        -------
        array, shape (..., outputs)
            In the precision of `u`.

        Raises
        ------
        ValueError
            If `u` has another last axis, or a number outside [0, 1).

        Examples
        --------
        >>> from evenlight import points, warp
        >>> warp.TriangleHeitz().map(points.Sobol(2, seed=7).points(0, 8)).shape
        (8, 3)
        """
        numbers = self._rows("u", u, self.inputs)
        if numbers.size and not (numbers.min() >= 0 and numbers.max() < 1):
            raise ValueError(f"u must be in [0, 1), not from {numbers.min()} to {numbers.max()}")
        return self._run(self._core.map, numbers, (self.outputs,), workers)

    def density(self, x: Any, *, workers: SupportsIndex = 1) -> Any:
        """The density of mapped uniform numbers.

        Parameters
        ----------
        x : array_like, shape (..., outputs)
            Points.
        workers : int, optional
            The most threads to use, -1 for all processors.

        Returns
        -------
        array, shape (...)
            0 where the warp does not lead.

        Raises
        ------
        ValueError
            If `x` has another last axis.

        Examples
        --------
        >>> from evenlight import warp
        >>> warp.TriangleHeitz().density([[0.25, 0.25, 0.5], [1.5, -0.25, -0.25]])
        array([2., 0.])
        """
        return self._run(self._core.density, self._rows("x", x, self.outputs), (), workers)

    def invert(self, x: Any, *, workers: SupportsIndex = 1) -> Any:
        """The uniform numbers that lead to points.

        Parameters
        ----------
        x : array_like, shape (..., outputs)
            Points that `map` can give; of others, the numbers mean nothing.
        workers : int, optional
            The most threads to use, -1 for all processors.

        Returns
        -------
        array, shape (..., inputs)

        Raises
        ------
        ValueError
            If `x` has another last axis.

        Examples
        --------
        >>> from evenlight import warp
        >>> warp.TriangleHeitz().invert([0.125, 0.625, 0.25])
        array([0.25, 0.75])
        """
        return self._run(self._core.invert, self._rows("x", x, self.outputs), (self.inputs,), workers)

    def __repr__(self) -> str:
        """Return the expression that builds the warp."""
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self._options.items())})"

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the plain values."""
        return _rebuilt, (type(self), self._options)

    @staticmethod
    def _rows(name: str, values: Any, columns: int) -> Numbers:
        array = np.asarray(values)
        array = np.ascontiguousarray(array, dtype=np.float32 if array.dtype == np.float32 else np.float64)
        if array.ndim == 0 or array.shape[-1] != columns:
            raise ValueError(f"{name} must have {columns} numbers in its last axis, not shape {np.shape(values)}")
        return array

    def _run(self, work: Any, rows: Numbers, tail: tuple[int, ...], workers: SupportsIndex) -> Any:
        out = np.empty((*rows.shape[:-1], *tail), dtype=rows.dtype)
        work(rows, out, threads(workers))
        return out


def _rebuilt(kind: type[Warp], options: dict[str, Any]) -> Warp:
    return kind(**options)
