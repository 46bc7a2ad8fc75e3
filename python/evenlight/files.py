"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from evenlight import _core

__all__ = ["check_writable", "replacing"]


def check_writable(path: str | os.PathLike[str]) -> None:
    """Find out before a long run whether a file can be written.

    Parameters
    ----------
    path : path
        The file to be written later. It is neither made nor changed.

    Raises
    ------
    OSError
        If its folder does not exist or cannot be written, or if the path is not that of a regular file.
    """
    _core.check_writable(os.fspath(path))


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Open a temporary file that takes the place of `path` when the block ends without an exception.

    Parameters
    ----------
    path : path
        The file to make or replace. A link keeps pointing where it points.

    Yields
    ------
    file : binary file
        Open for writing, in the folder of `path`.
    """
    check_writable(path)
    target = Path(path).resolve()
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=".tmp", dir=target.parent)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        temporary.chmod(_mode_of_new_files())
        temporary.replace(target)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def _mode_of_new_files() -> int:
    """Permissions as `open` gives them: temporary files are private."""
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
