"""What Python has not: the speed of memory, and the crate `sobol_burley`. Compiled from `benches/yardsticks/`."""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import numpy.typing as npt

__all__ = ["Yardsticks"]

HERE = Path(__file__).resolve().parent
Floats = npt.NDArray[np.float32] | npt.NDArray[np.float64]


class Yardsticks:
    """The library of `benches/yardsticks/`, built for this very processor."""

    def __init__(self) -> None:
        target = HERE.parent / "target" / "yardsticks"
        flags = {"RUSTFLAGS": "-C target-cpu=native", "CARGO_TARGET_DIR": str(target)}
        command = ["cargo", "build", "--release", "--locked", "--quiet"]
        subprocess.run(command, cwd=HERE / "yardsticks", env=os.environ | flags, check=True)
        suffix = {"darwin": "dylib", "win32": "dll"}.get(sys.platform, "so")
        prefix = "" if sys.platform == "win32" else "lib"
        self._library = ctypes.CDLL(str(target / "release" / f"{prefix}yardsticks.{suffix}"))

    def stream(self, out: Floats) -> None:
        """Write one number everywhere, past the caches: nothing can fill an array faster for long."""
        self._library.stream(_address(out), ctypes.c_size_t(out.nbytes // 4))

    def burley(self, out: npt.NDArray[np.float32]) -> None:
        """Fill with points of `sobol_burley::sample_4d`, with a new seed for every 2^16 of them."""
        rows, dims = out.shape
        self._library.burley(_address(out), ctypes.c_uint32(rows), ctypes.c_uint32(dims), ctypes.c_uint32(1))


def _address(out: Floats) -> ctypes.c_void_p:
    return ctypes.c_void_p(out.ctypes.data)
