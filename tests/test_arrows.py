"""The dependency arrows: points <- render <- python (the door) <- the Python package."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parent.parent

# What each crate of ours may use of the others.
ARROWS: dict[str, set[str]] = {
    "evenlight-points": set(),
    "evenlight-render": {"evenlight-points"},
    "evenlight-python": {"evenlight-points", "evenlight-render"},
}
PYTHON_ONLY = {"pyo3", "numpy"}


@pytest.fixture(scope="module")
def metadata() -> Any:
    """The dependency graph as cargo sees it."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def everything_below(metadata: Any, crate: str) -> set[str]:
    """The names of all crates that a crate is built from, at any distance; tests and benches aside."""
    names = {package["id"]: package["name"] for package in metadata["packages"]}
    edges = {
        node["id"]: [link["pkg"] for link in node["deps"] if any(kind["kind"] != "dev" for kind in link["dep_kinds"])]
        for node in metadata["resolve"]["nodes"]
    }
    found: set[str] = set()
    waiting = [identity for identity, name in names.items() if name == crate]
    while waiting:
        for identity in edges[waiting.pop()]:
            if identity not in found:
                found.add(identity)
                waiting.append(identity)
    return {names[identity] for identity in found}


def test_every_crate_of_the_workspace_has_its_arrows_listed(metadata: Any) -> None:
    names = {package["id"]: package["name"] for package in metadata["packages"]}
    assert {names[member] for member in metadata["workspace_members"]} == set(ARROWS)


@pytest.mark.parametrize("crate", ARROWS)
def test_crates_use_only_the_crates_they_may(metadata: Any, crate: str) -> None:
    assert everything_below(metadata, crate) & set(ARROWS) <= ARROWS[crate]


@pytest.mark.parametrize("crate", ["evenlight-points", "evenlight-render"])
def test_the_core_does_not_know_python(metadata: Any, crate: str) -> None:
    assert not everything_below(metadata, crate) & PYTHON_ONLY


def test_points_stand_almost_alone(metadata: Any) -> None:
    assert len(everything_below(metadata, "evenlight-points")) <= 10


def test_python_modules_use_only_the_modules_they_may() -> None:
    command = [str(Path(sys.executable).with_name("lint-imports")), "--no-cache"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
