"""Tables that ship: each with its source, its license and a script that makes it anew."""

from __future__ import annotations

import re
import runpy
import shutil
from pathlib import Path

import pytest

from conftest import ROOT

DATA = ROOT / "crates" / "points" / "src" / "data"
TABLES = sorted(path.name for path in DATA.glob("*.bin"))
SCRIPTS = sorted(path.name for path in DATA.glob("*.py"))
DOCUMENT = (DATA / "README.md").read_text(encoding="utf-8")


def section(name: str) -> str:
    """What the document says of a table."""
    found = re.search(rf"^## .*`{re.escape(name)}`.*?(?=^## |\Z)", DOCUMENT, flags=re.DOTALL | re.MULTILINE)
    assert found, f"{name} has no section"
    return found[0]


def test_the_document_lists_every_file() -> None:
    assert TABLES
    for name in TABLES + SCRIPTS:
        assert f"| `{name}` |" in DOCUMENT, name


def _makes(program: Path, name: str) -> bool:
    return program.is_file() and name in program.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", TABLES)
def test_every_table_has_source_license_and_script(name: str) -> None:
    text = section(name)
    assert re.search("licen[sc]e|of our own", text, flags=re.IGNORECASE), name
    programs = [script for script in SCRIPTS if name in (DATA / script).read_text(encoding="utf-8")]
    programs += [path for path in re.findall(r"`([\w./]+\.rs)`", DOCUMENT) if _makes(DATA / path, name)]
    assert programs, f"nothing makes {name}"


def test_the_script_makes_the_same_direction_numbers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The one table whose source is installed; the scripts of the others check the hash of theirs."""
    script = shutil.copy(DATA / "make_sobol.py", tmp_path)
    runpy.run_path(str(script), run_name="__main__")
    assert "21201 dimensions" in capsys.readouterr().out
    assert (tmp_path / "sobol.bin").read_bytes() == (DATA / "sobol.bin").read_bytes()
