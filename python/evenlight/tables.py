"""Points as files, in blocks, so that their number is not limited by memory."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO, Protocol

import numpy as np
from numpy.typing import NDArray

from evenlight import files

__all__ = ["PointSource", "write"]

BLOCK = 1 << 16  # rows: half a megabyte per dimension


class PointSource(Protocol):
    """What gives the rows of a table by index."""

    def points(self, start: int, stop: int) -> NDArray[np.float64]:
        """Rows `start` to `stop`, shape (stop - start, dims)."""
        ...


def write(path: str | os.PathLike[str], source: PointSource, rows: range, dims: int) -> None:
    """Write rows of points as `.npy` or `.csv`, or as CSV to standard output for `-`.

    Parameters
    ----------
    path : path or "-"
        Its suffix chooses the format. Files are written whole or not at all.
    source : PointSource
        Where the points come from.
    rows : range
        Which of them, consecutive.
    dims : int
        Columns.

    Raises
    ------
    ValueError
        If the suffix is unknown.
    OSError
        If the file cannot be written.
    """
    if os.fspath(path) == "-":
        _write_csv(sys.stdout.buffer, source, rows, dims)
        sys.stdout.buffer.flush()
        return
    suffix = Path(path).suffix.lower()
    if suffix not in _WRITERS:
        raise ValueError(f"{os.fspath(path)}: unknown table suffix '{suffix}'; known: {', '.join(_WRITERS)}")
    with files.replacing(path) as file:
        _WRITERS[suffix](file, source, rows, dims)


def _blocks(source: PointSource, rows: range) -> Iterator[NDArray[np.float64]]:
    for start in range(rows.start, rows.stop, BLOCK):
        yield source.points(start, min(start + BLOCK, rows.stop))


def _write_csv(file: BinaryIO, source: PointSource, rows: range, dims: int) -> None:
    """Write numbers with all digits: 17 give the same bits back."""
    del dims
    for block in _blocks(source, rows):
        np.savetxt(file, block, fmt="%.17g", delimiter=",")


def _write_npy(file: BinaryIO, source: PointSource, rows: range, dims: int) -> None:
    header = {"descr": "<f8", "fortran_order": False, "shape": (len(rows), dims)}
    np.lib.format.write_array_header_1_0(file, header)
    for block in _blocks(source, rows):
        file.write(np.ascontiguousarray(block, "<f8").data)


_WRITERS = {".csv": _write_csv, ".npy": _write_npy}
