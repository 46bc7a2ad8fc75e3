"""What several tests need."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from evenlight import points

ROOT = Path(__file__).resolve().parent.parent

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def scenes() -> Path:
    """The folder of our own scenes."""
    return ROOT / "scenes"


@pytest.fixture
def evenlight_command(tmp_path: Path) -> Run:
    """Run the command line in a process and a folder of its own."""

    def run(*arguments: str | os.PathLike[str]) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "evenlight", *(os.fspath(argument) for argument in arguments)]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=100)

    return run


def fitting_dims(name: str, d: int) -> int:
    """As many of d dimensions as a sequence has."""
    return min(d, next(info.most_dims for info in points.available() if info.name == name))


def sobol_matrices(d: int) -> dict[str, Any]:
    """Sobol' points as a net of one's own: 2^20 points and 40 digits, as in crates/points/tests/examples/mod.rs."""
    kept = min(max(d, 1), 21_201)
    columns = points.Sobol(kept).generating_matrices()[:, :20] >> np.uint64(24)
    return {"matrices": np.resize(columns, (d, 20)).tolist(), "bits": 40}


def fitting_count(name: str, d: int, least: int) -> dict[str, Any]:
    """What a set of d dimensions and at least some number of points must be told; nothing for sequences."""
    if name == "digital_net":
        return sobol_matrices(d)
    if not points.SEQUENCES[name].finite:
        return {}
    if name == "stratified":
        side = 1
        while side**d < least:
            side += 1
        return {"n": side**d}
    if name == "orthogonal_array":
        side = 2
        while side**2 < least or side + 1 < d or any(side % divisor == 0 for divisor in range(2, side)):
            side += 1
        return {"n": side**2}
    if name == "fibonacci":
        before, last = 1, 1
        while last < least:
            before, last = last, before + last
        return {"n": last}
    return {"n": least}
