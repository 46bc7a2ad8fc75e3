"""Diffusion through a random medium on the unit square: the standard problem with partial derivatives."""

from __future__ import annotations

from typing import SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.level_sampler import Coupled, LevelSampler

from .fields import Field, as_field
from .five_point import mean_solutions
from .mixed_difference import MixedDifference

__all__ = ["Diffusion2D", "IndexedDiffusion2D"]

Array = NDArray[np.float64]


class Diffusion2D(LevelSampler):
    """The mean over the unit square of v in -div(a grad v) = 1, v = 0 on the boundary, a random.

    Level l has a mesh of first_cells * 2^l cells a side.

    Parameters
    ----------
    field : {"log_normal", "uniform"} or Field
        The coefficient a.
    first_cells : int
        A side, on level 0.

    Raises
    ------
    ValueError
        If the name is unknown or there are fewer than 2 cells.

    Notes
    -----
    Finite volumes of five points. For fields with finitely many smooth terms errors fall by 4 per level and variances
    by 16. Cost: one unit per cell of either mesh, as measured from 32 to 128 cells a side; coarser ones are cheaper
    than that, and much finer ones dearer. All levels take the same numbers.

    Reference: K. A. Cliffe, M. B. Giles, R. Scheichl and A. L. Teckentrup, Comput. Vis. Sci. 14(1), 3-15 (2011).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import Diffusion2D
    >>> model = Diffusion2D("uniform")
    >>> coupled = model.sample(2, np.random.default_rng(1).random((100, model.dims(2))))
    >>> round(float(coupled.fine.mean()), 3), bool(coupled.difference.std() < 3e-4)
    (0.035, True)
    """

    max_level = None
    keyed = False

    def __init__(self, field: str | Field = "log_normal", *, first_cells: SupportsIndex = 4) -> None:
        self.field = as_field(field)
        self.first_cells = integer("first_cells", first_cells, 2)
        self.name = f"diffusion_2d {type(self.field).__name__}"

    def cells(self, level: int) -> int:
        """A side of the fine mesh."""
        return self.first_cells << integer("level", level, 0)

    def dims(self, level: int) -> int:
        """Those of the field."""
        return self.field.terms

    def cost(self, level: int) -> float:
        """Cells of both meshes."""
        return float(self.cells(level) ** 2 + (self.cells(level - 1) ** 2 if level else 0))

    def sample(self, level: int, u: Array) -> Coupled:
        """The quantity on the fine mesh and on the coarse one."""
        numbers = self._checked(u)
        fine = self._means(numbers, level)
        coarse = self._means(numbers, level - 1) if level else np.zeros(len(numbers))
        return Coupled(fine, coarse, len(numbers) * self.cost(level))

    def ladder(self, level: int, u: Array) -> Array:
        """The quantity on all meshes up to that of `level`, shape (n, level + 1)."""
        numbers = self._checked(u)
        return np.stack([self._means(numbers, rung) for rung in range(level + 1)], axis=1)

    def _means(self, u: Array, level: int) -> Array:
        return mean_solutions(self.field, u, (self.cells(level), self.cells(level)))

    def _checked(self, u: Array) -> Array:
        numbers = np.asarray(u, np.float64)
        if numbers.ndim != 2 or numbers.shape[1] != self.field.terms:
            raise ValueError(f"u must have shape (n, {self.field.terms}), not {numbers.shape}")
        return numbers


class IndexedDiffusion2D(MixedDifference):
    """`Diffusion2D` with two directions of refinement: the cells along x and along y.

    Parameters
    ----------
    field : {"log_normal", "uniform"} or Field
        The coefficient a.
    first_cells : int
        In either direction, on level (0, 0).

    Raises
    ------
    ValueError
        If the name is unknown or there are fewer than 2 cells.

    Notes
    -----
    Mixed differences fall by 4 per level in either direction, their variances by 16. Cost: one unit per cell.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import IndexedDiffusion2D
    >>> model = IndexedDiffusion2D("uniform")
    >>> u = np.random.default_rng(1).random((100, model.dims((2, 1))))
    >>> bool(np.abs(model.sample((2, 1), u).difference).max() < 1e-4)
    True
    """

    max_level = (None, None)

    def __init__(self, field: str | Field = "log_normal", *, first_cells: SupportsIndex = 4) -> None:
        self.field = as_field(field)
        self.first_cells = integer("first_cells", first_cells, 2)
        self.name = f"indexed_diffusion_2d {type(self.field).__name__}"

    def _cells(self, level: tuple[int, int]) -> tuple[int, int]:
        return self.first_cells * 2 ** level[0], self.first_cells * 2 ** level[1]

    def dims(self, level: tuple[int, int]) -> int:
        """Those of the field."""
        return self.field.terms

    def value(self, level: tuple[int, int], u: Array) -> Array:
        """The quantity on one mesh."""
        return mean_solutions(self.field, u, self._cells(level))

    def value_cost(self, level: tuple[int, int]) -> float:
        """The cells of the mesh."""
        nx, ny = self._cells(level)
        return float(nx * ny)
