"""Generating matrices of digital nets from the files in which others publish them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import SupportsIndex

import numpy as np
import numpy.typing as npt

__all__ = ["read_direction_numbers", "read_matrices"]

_DIGITS = 64


def read_direction_numbers(path: str | os.PathLike[str], d: SupportsIndex | None = None) -> npt.NDArray[np.uint64]:
    r"""Read Sobol' direction numbers in the format of S. Joe and F. Y. Kuo, for `DigitalNet`.

    Other sets than those that ship with `Sobol` and `SobolTkrg`, such as Joe and Kuo's for criteria other than D(6).
    Measured: 50,000 dimensions in two seconds.

    Parameters
    ----------
    path : path
        A text file with lines ``d s a m_1 ... m_s``: the dimension from 2 on, the degree and the inner coefficients of
        the polynomial, and the initial numbers. Other lines are left out.
    d : int, optional
        The dimensions to read; all by default.

    Returns
    -------
    ndarray of uint64, shape (d, 64)
        The columns of the matrices, first digit in the most significant of 64 bits.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If a line is not as above, or there are fewer dimensions than asked; the message names the dimension.

    Notes
    -----
    Reference: P. Bratley and B. L. Fox, ACM Trans. Math. Softw. 14, 88-100 (1988), equation 5.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from evenlight.points import DigitalNet, Sobol, read_direction_numbers
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "numbers.txt")
    ...     size = path.write_text("d s a m_i\n2 1 0 1\n3 2 1 1 3\n")
    ...     net = DigitalNet(matrices=read_direction_numbers(path), bits=64, seed=7)
    >>> bool((net.random(8) == Sobol(3, seed=7).random(8)).all())
    True
    """
    wanted = None if d is None else d.__index__()
    by_degree: dict[int, list[tuple[int, list[int]]]] = {}
    dims = 1
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        fields = line.split()
        if dims == wanted:
            break
        if fields and fields[0].isdecimal():
            dims += 1
            by_degree.setdefault(int(fields[1]), []).append((dims, _checked(path, dims, [int(x) for x in fields])))
    if wanted is not None and dims < wanted:
        raise ValueError(f"{os.fspath(path)} has {dims} dimensions, not {wanted}")
    matrices = np.empty((dims, _DIGITS), np.uint64)
    matrices[0] = [1 << (_DIGITS - 1 - k) for k in range(_DIGITS)]
    for degree, lines in by_degree.items():
        numbers = np.array([fields[2:] for _, fields in lines], np.uint64)
        matrices[[dim - 1 for dim, _ in lines]] = _columns(degree, numbers[:, 0], numbers[:, 1:])
    return matrices


def _checked(path: str | os.PathLike[str], dim: int, fields: list[int]) -> list[int]:
    number, degree, inner, *initial = fields
    odd = all(m % 2 == 1 and m < 2 << k for k, m in enumerate(initial))
    if number != dim or not 1 <= degree <= _DIGITS or inner >> (degree - 1) or len(initial) != degree or not odd:
        raise ValueError(
            f"{os.fspath(path)}, dimension {dim}: the line must be d s a m_1 ... m_s "
            "with a < 2^(s - 1) and odd m_k < 2^k"
        )
    return fields


def _columns(degree: int, inner: npt.NDArray[np.uint64], initial: npt.NDArray[np.uint64]) -> npt.NDArray[np.uint64]:
    """The columns of all matrices whose polynomials have this degree."""
    columns = np.empty((len(inner), _DIGITS), np.uint64)
    for k in range(_DIGITS):
        if k < degree:
            columns[:, k] = initial[:, k] << np.uint64(_DIGITS - 1 - k)
            continue
        columns[:, k] = columns[:, k - degree] ^ (columns[:, k - degree] >> np.uint64(degree))
        for j in range(1, degree):
            present = (inner >> np.uint64(degree - 1 - j)) & np.uint64(1)
            columns[:, k] ^= present * columns[:, k - j]
    return columns


def read_matrices(path: str | os.PathLike[str]) -> tuple[npt.NDArray[np.uint64], int]:
    r"""Read a digital net in the format of the LDData collection and D. Nuyens's Magic Point Shop, for `DigitalNet`.

    Parameters
    ----------
    path : path
        A text file: base, number of dimensions, number of points and digits of a column in a line each, then the
        columns of one matrix in each line. What follows a ``#`` is left out.

    Returns
    -------
    matrices : ndarray of uint64, shape (d, m)
        The columns.
    bits : int
        The digits of a column; the first is the most significant of so many bits.

    Raises
    ------
    OSError
        If the file cannot be read.
    ValueError
        If it is not as above, or not in base 2.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from evenlight.points import DigitalNet, read_matrices
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "net.txt")
    ...     size = path.write_text("# dnet\n2 # base\n2\n4\n2 # digits\n1 2\n2 1\n")
    ...     matrices, bits = read_matrices(path)
    >>> DigitalNet(matrices=matrices, bits=bits, scramble="none").points(1, 3)
    array([[0.25, 0.5 ],
           [0.5 , 0.25]])
    """
    lines = [line.split("#")[0].split() for line in Path(path).read_text(encoding="utf-8").splitlines()]
    numbers = [[int(field) for field in line] for line in lines if line]
    header, rows = [line[0] for line in numbers[:4]], numbers[4:]
    sizes = {len(row) for row in rows}
    if len(header) < 4 or len(rows) != header[1] or len(sizes) != 1 or 1 << min(sizes) != header[2]:
        raise ValueError(f"{os.fspath(path)} must have base, d, 2^m and digits, then d lines of m columns")
    if header[0] != 2:
        raise ValueError(f"{os.fspath(path)} is a net in base {header[0]}, not 2")
    return np.array(rows, np.uint64), header[3]
