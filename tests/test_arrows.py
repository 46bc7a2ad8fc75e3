"""The dependency arrows: points <- render <- python (the door) <- the Python package."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from conftest import ROOT
from evenlight import _core, blue_noise, points

# What each crate of ours may use of the others.
ARROWS: dict[str, set[str]] = {
    "evenlight-points": set(),
    "evenlight-points-c": {"evenlight-points"},
    "evenlight-render": {"evenlight-points"},
    "evenlight-python": {"evenlight-points", "evenlight-render"},
}
PYTHON_ONLY = {"pyo3", "numpy"}


FAMILIES: dict[str, list[str]] = {
    "points/src/sequences": [info.name for info in points.available()],
    "points/src/scramble": _core.scrambles(),
    "points/src/blue_noise": [info.name for info in blue_noise.available()],
    "points/src/warp": _core.warps(),
    "render/src/bsdf": _core.bsdfs(),
    "render/src/emitter": _core.emitters(),
    "render/src/filter": _core.filters(),
    "render/src/integrator": _core.integrators(),
    "render/src/sampler": _core.samplers(),
    "render/src/sensor": _core.sensors(),
    "render/src/shape": _core.shapes(),
    "render/src/texture": _core.textures(),
}
# Members that are another member in a special case.
SPECIAL_CASES = {
    ("catmullrom", "mitchell"),  # with B = 0 and C = 1/2
    ("halton", "independent"),  # beyond the last prime
    ("orthographic", "perspective"),  # the same clip planes
    ("thinlens", "perspective"),  # with a lens
    ("zsobol", "sobol"),  # with one sequence for all pixels
}


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


@pytest.mark.parametrize("crate", ["evenlight-points", "evenlight-points-c", "evenlight-render"])
def test_the_core_does_not_know_python(metadata: Any, crate: str) -> None:
    assert not everything_below(metadata, crate) & PYTHON_ONLY


def test_points_stand_almost_alone(metadata: Any) -> None:
    assert len(everything_below(metadata, "evenlight-points")) <= 10


def test_python_modules_use_only_the_modules_they_may() -> None:
    command = [str(Path(sys.executable).with_name("lint-imports")), "--no-cache"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("folder", FAMILIES)
def test_members_of_a_family_do_not_import_each_other(folder: str) -> None:
    names = set(FAMILIES[folder])
    family = Path(folder).name
    for name in names:
        sources = [ROOT / "crates" / folder / f"{name}.rs", *(ROOT / "crates" / folder / name).glob("*.rs")]
        text = "\n".join(source.read_text(encoding="utf-8") for source in sources if source.exists())
        assert text, name
        imported = re.findall(rf"\b(?:super|{family})::(\w+|\{{[^}}]*\}})", text)
        siblings = names.intersection(re.findall(r"\w+", " ".join(imported))) - {name}
        assert {(name, sibling) for sibling in siblings} <= SPECIAL_CASES
