"""Diffusion on the unit square by finite volumes: small systems together by LAPACK, others by SuperLU."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import linalg, sparse
from scipy.sparse.linalg import splu

from .fields import Field
from .row_blocks import row_blocks

__all__ = ["mean_solutions"]

Array = NDArray[np.float64]

_BLOCK = 2**18  # numbers of a banded matrix: solved together, small systems cost no call each
_NARROW = 15  # beyond this width LAPACK's blocks are large enough for threads, which cost more than they bring


def mean_solutions(field: Field, u: Array, cells: tuple[int, int]) -> Array:
    """The integral of v over the square for -div(a grad v) = 1, v = 0 on the boundary, on a mesh of nx by ny cells.

    Parameters
    ----------
    field : Field
        The coefficient a, taken at the middle of the line between two nodes.
    u : ndarray of float64, shape (n, terms)
        Uniform numbers of the field.
    cells : (int, int)
        Of the mesh, at least 2 each.

    Returns
    -------
    ndarray of float64, shape (n,)
        With an error of order nx^-2 + ny^-2.

    Notes
    -----
    Measured per unknown: 0.1 to 0.2 microseconds for up to 15 nodes on the shorter side (Cholesky's factors of a band,
    the systems of a block as one matrix), 2 to 3 microseconds from there to 127 (SuperLU, one by one).
    """
    # The longer side is the outer one: the band is narrow.
    swapped = cells[0] < cells[1]
    nx, ny = cells[::-1] if swapped else cells
    places = _edges(nx, ny)
    places = places[::-1] if swapped else places
    unknowns, width = (nx - 1) * (ny - 1), ny - 1
    numbers = _BLOCK if width <= _NARROW else 0
    means = np.empty(len(u))
    for rows in row_blocks(len(u), unknowns * (width + 1), numbers=numbers, least=1):
        band = _band(field.values(u[rows], *places), nx, ny)
        solution = _by_band(band) if width <= _NARROW else _by_sparse(band)
        means[rows] = solution.reshape(-1, unknowns).sum(axis=1) / (nx * ny)
    return means


def _edges(nx: int, ny: int) -> tuple[Array, Array]:
    """Middles of lines along x, shape nx * (ny - 1), then of lines along y, shape (nx - 1) * ny."""
    x, y = np.arange(1, nx) / nx, np.arange(1, ny) / ny
    x_middle, y_middle = (np.arange(nx) + 0.5) / nx, (np.arange(ny) + 0.5) / ny
    along_x = np.meshgrid(x_middle, y, indexing="ij")
    along_y = np.meshgrid(x, y_middle, indexing="ij")
    first, second = (np.concatenate([a.ravel(), b.ravel()]) for a, b in zip(along_x, along_y, strict=True))
    return first, second


def _band(coefficient: Array, nx: int, ny: int) -> Array:
    """The matrices of n coefficients in LAPACK's upper form, shape (ny, n * unknowns).

    A column holds the entries of its node and of those before it, the diagonal last.
    """
    n, width = len(coefficient), ny - 1
    split = nx * width
    along_x = coefficient[:, :split].reshape(n, nx, width) * float(nx * nx)
    along_y = coefficient[:, split:].reshape(n, nx - 1, ny) * float(ny * ny)
    band = np.zeros((width + 1, n, nx - 1, width))
    band[width] = along_x[:, :-1] + along_x[:, 1:] + along_y[:, :, :-1] + along_y[:, :, 1:]
    band[0, :, 1:] -= along_x[:, 1:-1]
    band[width - 1, :, :, 1:] -= along_y[:, :, 1:-1]
    return band.reshape(width + 1, -1)


def _by_band(band: Array) -> Array:
    right = np.ones(band.shape[1])
    return np.asarray(linalg.solveh_banded(band, right, overwrite_ab=True, overwrite_b=True, check_finite=False))


def _by_sparse(band: Array) -> Array:
    width = len(band) - 1
    near, far = band[width - 1, 1:], band[0, width:]
    matrix = sparse.diags_array([band[width], near, near, far, far], offsets=[0, 1, -1, width, -width])
    factors = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    return np.asarray(factors.solve(np.ones(band.shape[1])))
