"""README and guides are true: their examples run and print what they say; the table of families is the registries'."""

from __future__ import annotations

import math
import re
import shlex
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from conftest import ROOT
from evenlight import _core, blue_noise, cli, domains, importance, integrands, mcmc, points, rules, smc
from evenlight.multilevel import models

README = (ROOT / "README.md").read_text(encoding="utf-8")
GUIDES = sorted((ROOT / "docs").glob("*.md"))
LONGEST_GUIDE = 125


def blocks(language: str, text: str = README) -> list[str]:
    """The code blocks in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", text, flags=re.DOTALL | re.MULTILINE)


def promised(block: str) -> list[str]:
    """The words that a block's comments say it prints: behind a `print(…)`, and in the comment lines below it."""
    said = re.findall(r"^ *print\(.*?\)(?:  #(.*))?\n((?:#.*\n)*)", block, flags=re.MULTILINE)
    return [word for behind, below in said for word in (behind + re.sub(r"^#", "", below, flags=re.MULTILINE)).split()]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that holds our scenes and whatever the examples write."""
    (tmp_path / "scenes").symlink_to(ROOT / "scenes", target_is_directory=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_python_example_runs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    example, *_ = blocks("python")
    assert len(example.splitlines()) <= 10
    names: dict[str, Any] = {}
    exec(example, names)
    shapes, relative_error = capsys.readouterr().out.splitlines()
    assert f"# {shapes}" in example
    assert 0 < float(relative_error) < 1
    assert (folder / "demo.exr").is_file()
    assert (folder / "demo.png").is_file()
    assert names["x"].shape == (1024, 8)


def test_the_example_of_an_integral_runs(capsys: pytest.CaptureFixture[str]) -> None:
    _, example, *_ = blocks("python")
    names: dict[str, Any] = {}
    exec(example, names)
    assert f"# {capsys.readouterr().out.strip()}" in example
    assert names["low"] < 0.4165383858866382 < names["high"]


def test_the_example_of_a_mixture_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = (block for block in blocks("python") if "mixture_estimate" in block)
    names: dict[str, Any] = {}
    exec(example, names)
    assert f"# {capsys.readouterr().out.strip()}" in example
    assert abs(names["estimate"].value - 1.3498980316e-3) < 4 * names["estimate"].standard_error


def test_the_example_of_levels_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = (block for block in blocks("python") if "mlmc" in block)
    names: dict[str, Any] = {}
    exec(example, names)
    shown, *table = capsys.readouterr().out.splitlines()
    assert f"# {shown}" in example
    assert len(table) == len(names["estimate"].diagnostics["levels"]) + 1
    assert abs(names["estimate"].value - (math.e - 1)) < 3e-3


def test_the_example_of_chains_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = (block for block in blocks("python") if "evenlight.mcmc" in block)
    exec(example, {})
    assert f"# {' '.join(capsys.readouterr().out.split())}\n" in example


def test_the_example_of_particles_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (example,) = (block for block in blocks("python") if "smc" in block)
    names: dict[str, Any] = {}
    exec(example, names)
    evidence, exact = capsys.readouterr().out.splitlines()
    assert f"# {evidence}" in example
    assert abs(names["evidence"].value - float(exact)) < 5 * names["evidence"].standard_error
    assert abs(names["waiting"].value - 3.138196) < 5 * names["waiting"].standard_error


@pytest.mark.parametrize("guide", GUIDES, ids=lambda path: path.stem)
def test_guides_run_and_print_what_they_say(guide: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = guide.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= LONGEST_GUIDE
    assert f"(docs/{guide.name})" in README
    names: dict[str, Any] = {}
    for block in blocks("python", text):
        exec(block, names)
        assert capsys.readouterr().out.split() == promised(block)


def commands() -> list[str]:
    """Lines of the shell blocks that call the program."""
    texts = [README, *(guide.read_text(encoding="utf-8") for guide in GUIDES)]
    lines = [line for text in texts for block in blocks("sh", text) for line in block.splitlines()]
    return [line for line in lines if line.startswith("evenlight ")]


@pytest.mark.parametrize("command", commands())
def test_the_commands_run(folder: Path, command: str) -> None:
    arguments = shlex.split(command)[1:]
    assert cli.main(arguments) == 0
    for flag, name in pairwise(arguments):
        if flag == "-o":
            assert (folder / name).is_file()


def test_set_up_is_two_commands() -> None:
    lines = [line.split("#")[0].split() for block in blocks("sh") for line in block.splitlines()]
    assert [line for line in lines if line[0] == "make"] == [["make", "demo"], ["make", "test"]]


FAMILIES = {
    "sequences": [info.name for info in points.available()],
    "scrambles": _core.scrambles(),
    "warps": _core.warps(),
    "blue noise": [info.name for info in blue_noise.available()],
    "rules": list(rules.RULES),
    "integrands": list(integrands.INTEGRANDS),
    "domains": list(domains.DOMAINS),
    "densities": list(importance.DENSITIES),
    "heuristics": list(importance.HEURISTICS),
    "models": list(models.MODELS),
    "payoffs": list(models.PAYOFFS),
    "fields": list(models.FIELDS),
    "formats": list(models.FORMATS),
    "kernels": list(mcmc.KERNELS),
    "driving": list(mcmc.DRIVING),
    "dynamics": list(smc.MODELS),
    "chains": list(smc.CHAINS),
    "resampling": list(smc.RESAMPLING),
    "smoothers": list(smc.SMOOTHERS),
    "sorts": list(smc.SORTS),
    "samplers": _core.samplers(),
    "integrators": _core.integrators(),
    "BSDFs": _core.bsdfs(),
    "emitters": [*_core.emitters(), "area"],  # built with its shape, not by the registry
    "shapes": _core.shapes(),
    "textures": _core.textures(),
    "sensors": _core.sensors(),
    "filters": _core.filters(),
}


def test_the_table_of_families_is_that_of_the_registries() -> None:
    rows = re.findall(r"^\| (\w+(?: \w+)?) \| (.*?) \| `(.*?)` \|$", README, flags=re.MULTILINE)
    members = {family: re.findall(r"`(\w+)`", names) for family, names, _ in rows}
    assert {family: sorted(names) for family, names in members.items()} == {
        family: sorted(names) for family, names in FAMILIES.items()
    }
    for _, _, place in rows:
        assert (ROOT / place / ("mod.rs" if place.startswith("crates") else "__init__.py")).is_file()


DOCUMENTS = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", *(f"docs/{guide.name}" for guide in GUIDES)]


@pytest.mark.parametrize("document", DOCUMENTS)
def test_files_that_documents_name_exist(document: str) -> None:
    text = (ROOT / document).read_text(encoding="utf-8")
    named = re.findall(r"`((?:crates|tests|python|scenes|benches|statistics|examples)/[\w./]*)`", text)
    linked = re.findall(r"\]\(([\w./-]+)\)", text)
    for name in named:
        if Path(name).stem != "x":  # the file that is to be added
            assert (ROOT / name).exists(), name
    for name in linked:
        assert ((ROOT / document).parent / name).exists(), name
