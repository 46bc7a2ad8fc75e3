"""The scripts in examples/ run, at small sizes, and what they print is right; `make demo` runs demo.py."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

import pytest

from conftest import ROOT

SMALL = {
    "convergence": ["--most", "1024", "--replicates", "50"],
    "mixing": ["--most", "32", "--steps", "200"],
    "own_sde": ["--rmse", "0.01"],
    "samplers": ["--size", "16x16", "--most", "64", "--repeats", "2"],
    "with_scipy": ["--n", "4096"],
}
LONGEST = 80  # lines of a script to copy


def run(name: str, capsys: pytest.CaptureFixture[str]) -> str:
    """Run a script at a small size, as itself, and give back what it printed."""
    specification = importlib.util.spec_from_file_location(name, ROOT / "examples" / f"{name}.py")
    assert specification is not None and specification.loader is not None
    script = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(script)
    assert script.main(SMALL[name]) == 0
    return capsys.readouterr().out


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder that holds our scenes and whatever the scripts write."""
    (tmp_path / "scenes").symlink_to(ROOT / "scenes", target_is_directory=True)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_every_script_is_tried_and_short() -> None:
    scripts = {path.stem: path for path in (ROOT / "examples").glob("*.py")}
    assert set(SMALL) == set(scripts) - {"demo"}
    assert not [name for name, path in scripts.items() if len(path.read_text(encoding="utf-8").splitlines()) > LONGEST]


def test_convergence(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = re.findall(r"(\w+), +(\w+): n\^\((\S+) ± (\S+)\)", run("convergence", capsys))
    slopes = {(function, points): (float(slope), float(error)) for function, points, slope, error in found}
    for function in "smooth", "kink", "jump":
        slope, error = slopes[function, "independent"]
        assert abs(slope + 0.5) < 4 * error  # false alarm 6e-5 each
        assert slopes[function, "sobol"][0] < -0.65
    assert slopes["smooth", "sobol"][0] < slopes["kink", "sobol"][0] < slopes["jump", "sobol"][0]
    assert (folder / "convergence.png").is_file()


def test_mixing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    printed = run("mixing", capsys)
    assert "walks from the left mode: 1.000" in printed
    assert (folder / "mixing.png").is_file()
    walk, lifted = (float(number) for number in re.findall(r"grow as N\^([\d.]+)", printed))
    assert abs(walk - 2) < 0.2 and abs(lifted - 1) < 0.2


def test_own_sde(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    values = re.findall(r"^\w+: (\S+) in", run("own_sde", capsys), flags=re.MULTILINE)
    exact = 0.098344  # by the noncentral chi-square law of X_1
    assert len(values) == 2 and all(abs(float(value) - exact) < 0.04 for value in values)  # 4 tolerances
    assert (folder / "own_sde.png").is_file()


def test_samplers(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    errors = {name: float(error) for name, error in re.findall(r"(\w+): (\S+) ±", run("samplers", capsys))}
    assert set(errors) == {"independent", "halton", "sobol", "zsobol"}
    assert errors["sobol"] < 0.8 * errors["independent"]  # 0.4 of it at usual sizes
    assert (folder / "samplers.png").is_file()


def test_with_scipy(capsys: pytest.CaptureFixture[str]) -> None:
    exact, *rest = re.findall(r"0\.2\d+", run("with_scipy", capsys))
    assert len(rest) == 3
    assert all(abs(float(value) - float(exact)) < 0.008 for value in rest)  # standard errors of 0.001 to 0.0015
