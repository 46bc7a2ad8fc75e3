"""The guides in docs/ are true: their code runs and prints what they say, their commands and links work."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any

import pytest

from conftest import ROOT
from documents import GUIDES, blocks, commands, link_scenes, promised, read
from evenlight import cli

LONGEST = 130  # lines of a guide


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that holds our scenes and whatever the examples write."""
    link_scenes(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("guide", GUIDES)
def test_the_code_prints_what_the_guide_says(guide: str, capsys: pytest.CaptureFixture[str]) -> None:
    names: dict[str, Any] = {}
    for block in blocks(read(f"docs/{guide}"), "python"):
        exec(compile(block, guide, "exec"), names)
        assert capsys.readouterr().out.splitlines() == promised(block)


@pytest.mark.parametrize(
    ("guide", "command"), [(guide, c) for guide in GUIDES for c in commands(read(f"docs/{guide}"))]
)
def test_the_commands_run(guide: str, command: str) -> None:
    assert cli.main(shlex.split(command)[1:]) == 0


@pytest.mark.parametrize("guide", GUIDES)
def test_a_guide_is_short_and_linked_from_the_readme(guide: str) -> None:
    assert len(read(f"docs/{guide}").splitlines()) <= LONGEST
    assert f"(docs/{guide})" in read("README.md")


@pytest.mark.parametrize("guide", GUIDES)
def test_links_lead_somewhere(guide: str) -> None:
    for name in re.findall(r"\]\(([\w./-]+)\)", read(f"docs/{guide}")):
        assert (ROOT / "docs" / name).exists(), name
