"""What a measurement was made on."""

from __future__ import annotations

import datetime
import os
import platform
from pathlib import Path

import evenlight

__all__ = ["describe", "find_llvm"]


def describe() -> dict[str, str]:
    """The date, the processor, and the versions of what is always there."""
    return {
        "date": datetime.datetime.now(tz=datetime.UTC).date().isoformat(),
        "processor": f"{_processor()}, {os.cpu_count()} cores",
        "system": f"{platform.system()} {platform.machine()}",
        "Python": platform.python_version(),
        "evenlight": evenlight.__version__,
    }


def find_llvm() -> str | None:
    """The LLVM library for Mitsuba's vectorized variants: the environment's choice, or the newest of the system."""
    named = os.environ.get("DRJIT_LIBLLVM_PATH")
    found = sorted(Path("/usr/lib").glob("*/libLLVM*.so*"))
    return named or (str(found[-1]) if found else None)


def _processor() -> str:
    """The name of the processor, where the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()
