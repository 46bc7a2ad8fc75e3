"""Documents whose code runs: their blocks by language, and what a block says that it prints."""

from __future__ import annotations

import re
from pathlib import Path

from conftest import ROOT

GUIDES = sorted(path.name for path in (ROOT / "docs").glob("*.md"))
"""The guides, by the names of their files."""


def read(name: str) -> str:
    """The text of a document."""
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(text: str, language: str) -> list[str]:
    """The code blocks in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE)


def commands(text: str) -> list[str]:
    """Lines of the shell blocks that call the program."""
    return [line for block in blocks(text, "sh") for line in block.splitlines() if line.startswith("evenlight ")]


def promised(block: str) -> list[str]:
    """The lines that a block says it prints: comments behind `print`, and lines of comment below."""
    found: list[str] = []
    printed = False
    for line in block.splitlines():
        code, _, comment = line.rpartition("  # ")
        if "print(" in code:
            found.append(comment)
        elif printed and line.startswith("# "):
            found.append(line[2:])
            continue
        printed = "print(" in line
    return found


def link_scenes(folder: Path) -> None:
    """Let a folder hold our scenes, as the examples expect."""
    (folder / "scenes").symlink_to(ROOT / "scenes", target_is_directory=True)
