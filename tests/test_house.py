"""House rules that no linter knows: sizes and names of files, and a first line that says what each is."""

from __future__ import annotations

from conftest import ROOT

FOLDERS = ("crates", "python", "tests", "statistics", "benches", "examples")
SOURCES = sorted(path for folder in FOLDERS for suffix in ("rs", "py") for path in (ROOT / folder).rglob(f"*.{suffix}"))
LONGEST = 400
VAGUE = ("utils", "common", "helpers", "manager", "misc")


def test_sources_are_short_and_well_named() -> None:
    assert SOURCES
    assert not [path for path in SOURCES if len(path.read_text(encoding="utf-8").splitlines()) > LONGEST]
    assert not [path for path in SOURCES if any(word in path.stem.lower() for word in VAGUE)]


def test_the_first_line_of_a_source_says_what_it_is() -> None:
    for path in SOURCES:
        text = path.read_text(encoding="utf-8")
        first = text.partition("\n")[2] if text.startswith("#!") else text
        assert first.startswith(("//!", '"""')) or not text, path
