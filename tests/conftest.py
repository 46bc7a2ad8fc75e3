"""What several tests need."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

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
