"""Diffusion through a random medium in one dimension: with a solver so cheap that levels are easy to see."""

from __future__ import annotations

from typing import SupportsIndex

import numpy as np
from numpy.typing import NDArray

from evenlight.arguments import integer
from evenlight.multilevel.level_sampler import Coupled, LevelSampler

from .fields import Field, as_field
from .mixed_difference import MixedDifference
from .row_blocks import row_blocks

__all__ = ["Diffusion1D", "IndexedDiffusion1D"]

Array = NDArray[np.float64]


def solve_1d(coefficient: Array) -> Array:
    """The integral of u over [0, 1] for -(a u')' = 1, u(0) = u(1) = 0, by linear finite elements.

    Parameters
    ----------
    coefficient : ndarray of float64, shape (n, cells)
        a at the midpoints of equal cells.

    Returns
    -------
    ndarray of float64, shape (n,)

    Notes
    -----
    In one dimension the system is solved in closed form: the flux is c - x, and c follows from u(1) = 0.
    """
    cells = coefficient.shape[1]
    middle = (np.arange(cells) + 0.5) / cells
    resistance = 1.0 / coefficient
    constant = (resistance @ middle) / resistance.sum(axis=1)
    # u at the end of cell i is the sum of (c - middle) resistance up to it; the trapezoidal rule sums those once more.
    rest = 1.0 - middle
    total = constant * (resistance @ rest) - resistance @ (middle * rest)
    return np.asarray(total / cells)


class Diffusion1D(LevelSampler):
    """The mean over [0, 1] of u in -(a u')' = 1, u(0) = u(1) = 0, a random; level l has first_cells * 2^l cells.

    Parameters
    ----------
    field : {"log_normal", "uniform"} or Field
        The coefficient a.
    first_cells : int
        On level 0.

    Raises
    ------
    ValueError
        If the name is unknown or there are no cells.

    Notes
    -----
    Linear finite elements with the coefficient at midpoints. For fields with finitely many smooth terms errors fall
    by 4 per level and variances by 16. Cost: one unit per cell, of either mesh. All levels take the same numbers.

    Reference: K. A. Cliffe, M. B. Giles, R. Scheichl and A. L. Teckentrup, "Multilevel Monte Carlo methods and
    applications to elliptic PDEs with random coefficients", Comput. Vis. Sci. 14(1), 3-15 (2011).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import Diffusion1D
    >>> model = Diffusion1D("uniform")
    >>> coupled = model.sample(4, np.random.default_rng(1).random((1000, model.dims(4))))
    >>> round(float(coupled.fine.mean()), 3), bool(coupled.difference.std() < 1e-4)
    (0.086, True)
    """

    max_level = None
    keyed = False

    def __init__(self, field: str | Field = "log_normal", *, first_cells: SupportsIndex = 4) -> None:
        self.field = as_field(field)
        self.first_cells = integer("first_cells", first_cells, 2)
        self.name = f"diffusion_1d {type(self.field).__name__}"

    def cells(self, level: int) -> int:
        """Of the fine mesh."""
        return self.first_cells << integer("level", level, 0)

    def dims(self, level: int) -> int:
        """Those of the field."""
        return self.field.terms

    def cost(self, level: int) -> float:
        """Cells of both meshes."""
        return float(self.cells(level) + (self.cells(level - 1) if level else 0))

    def sample(self, level: int, u: Array) -> Coupled:
        """The quantity on the fine mesh and on the coarse one."""
        numbers = _checked(u, self.dims(level))
        fine = _means(self.field, numbers, self.cells(level))
        coarse = _means(self.field, numbers, self.cells(level - 1)) if level else np.zeros(len(numbers))
        return Coupled(fine, coarse, len(numbers) * self.cost(level))

    def ladder(self, level: int, u: Array) -> Array:
        """The quantity on all meshes up to that of `level`, shape (n, level + 1)."""
        numbers = _checked(u, self.dims(level))
        return np.stack([_means(self.field, numbers, self.cells(rung)) for rung in range(level + 1)], axis=1)


class IndexedDiffusion1D(MixedDifference):
    """`Diffusion1D` with two directions of refinement: cells of the mesh, and terms of the field.

    Parameters
    ----------
    field : {"log_normal", "uniform"} or Field
        The coefficient a; its number of terms ends the second direction.
    first_cells, first_terms : int
        On level (0, 0); both double per level. Meshes much coarser than the terms of the field cannot see them: mixed
        differences then grow before they fall.

    Raises
    ------
    ValueError
        If the name is unknown, or a number impossible.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import IndexedDiffusion1D
    >>> model = IndexedDiffusion1D("uniform", first_terms=2)
    >>> model.max_level, model.dims((3, 1))
    ((None, 2), 4)
    >>> u = np.random.default_rng(1).random((1000, 4))
    >>> bool(model.sample((3, 1), u).difference.std() < 1e-4)
    True
    """

    def __init__(
        self,
        field: str | Field = "log_normal",
        *,
        first_cells: SupportsIndex = 8,
        first_terms: SupportsIndex = 1,
    ) -> None:
        self.field = as_field(field)
        self.first_cells = integer("first_cells", first_cells, 2)
        self.first_terms = integer("first_terms", first_terms, 1)
        if self.first_terms > self.field.terms:
            raise ValueError(f"first_terms must be at most those of the field, {self.field.terms}, not {first_terms}")
        self.name = f"indexed_diffusion_1d {type(self.field).__name__}"
        doublings = (self.field.terms // self.first_terms).bit_length() - 1
        self.max_level = (None, doublings)
        self.exact = self.first_terms << doublings == self.field.terms

    def dims(self, level: tuple[int, int]) -> int:
        """Terms of the field."""
        return self.first_terms << level[1]

    def value(self, level: tuple[int, int], u: Array) -> Array:
        """The quantity on one mesh with so many terms."""
        return _means(self.field, u[:, : self.dims(level)], self.first_cells * 2 ** level[0])

    def value_cost(self, level: tuple[int, int]) -> float:
        """Cells times terms."""
        return float(self.first_cells * 2 ** level[0] * self.dims(level))


def _means(field: Field, u: Array, cells: int) -> Array:
    middle = (np.arange(cells) + 0.5) / cells
    means = np.empty(len(u))
    for rows in row_blocks(len(u), cells):
        means[rows] = solve_1d(field.values(u[rows], middle))
    return means


def _checked(u: Array, dims: int) -> Array:
    numbers = np.asarray(u, np.float64)
    if numbers.ndim != 2 or numbers.shape[1] != dims:
        raise ValueError(f"u must have shape (n, {dims}), not {numbers.shape}")
    return numbers
