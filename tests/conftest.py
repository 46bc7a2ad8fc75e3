"""What several tests need."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

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


def fitting_count(name: str, d: int, least: int) -> dict[str, Any]:
    """A number of points that a finite set of d dimensions can have, at least some number; nothing for sequences."""
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
