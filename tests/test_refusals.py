"""What a newcomer or an enemy may type: one line that says what is allowed, exit code 2, and nothing left behind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import evenlight
from evenlight import cli

Refuse = Callable[..., str]
SMALL = ["--size", "4x4"]


@pytest.fixture
def refuse(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Refuse:
    """Run the command line in an empty folder, insist on an error of one line and give it back."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments: str | Path) -> str:
        before = sorted(tmp_path.iterdir())
        try:
            code: Any = cli.main([str(argument) for argument in arguments])
        except SystemExit as stop:  # argparse
            code = stop.code
        output, errors = capsys.readouterr()
        assert (code, output) == (2, "")
        assert errors.startswith("evenlight: error: ")
        assert errors.count("\n") == 1, errors
        assert sorted(tmp_path.iterdir()) == before, "nothing is left behind"
        return errors

    return run


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--sampler", "dice"], "'independent', 'sobol', 'halton'"),
        (["--integrator", "magic"], "'path'"),
        (["--filter", "sieve"], "'box', 'catmullrom', 'gaussian'"),
        (["--mis", "luck"], "'balance', 'power'"),
        (["--roulette", "1,x"], "'1,x' is not throughput, none or probabilities"),
        (["--roulette", "1,2"], "survival probabilities must be in (0, 1], not 2"),
        (["--kernel", "corn"], "'auto', 'embree', 'wide'"),
        (["--size", "0x0"], "'0x0' is not WIDTHxHEIGHT"),
        (["--size", "4 by 4"], "WIDTHxHEIGHT"),
        (["--size", "99999x99999"], "each must be 1 to 32768 pixels"),
        (["--size", "32768x32768"], "width × height × replicates up to 536870912 is allowed"),
        (["--spp", "4294967295", "--replicates", "4294967295"], "4294967295 replicates"),
        (["--spp", "10", "--replicates", "4"], "spp (10) must be a multiple of replicates (4)"),
        (["--spp", "many"], "many"),
        (["--spp", "-4"], "spp is -4; 1 to 4294967295 is allowed"),
        (["--spp", "99999999999"], "1 to 4294967295 is allowed"),
        (["--replicates", "0"], "replicates is 0; 1 to"),
        (["--threads", "0"], "threads is 0; 1 to 4096 is allowed"),
        (["--seed", "-1"], "seed is -1; 0 to 18446744073709551615 is allowed"),
        (["--max-depth", "-5"], "max_depth is -5; -1 to"),
        (["--exposure", "nan"], "'nan' is not a finite number of stops"),
        (["-D", "no_such=1"], "unknown parameter 'no_such'; known: radiance, reflectance, resx, resy"),
        (["-D", "kernel=1"], "unknown parameter 'kernel'; known: radiance, reflectance, resx, resy"),
        (["-D", "reflectance"], "'reflectance' is not NAME=VALUE"),
        (["-D", "reflectance=blue"], "sky.xml:42: <rgb>: 'blue' is not a number"),
        (["-D", "resx=0"], "width must be 1 to 32768 pixels, not 0"),
        (["--no-such-option"], "--no-such-option"),
    ],
)
def test_settings(refuse: Refuse, scenes: Path, options: list[str], message: str) -> None:
    assert message in refuse("render", scenes / "sky.xml", "-o", "a.exr", *options)


@pytest.mark.parametrize(
    ("output", "message"),
    [
        ("a.jpg", "unknown image suffix '.jpg'; known: .exr, .npz, .png"),
        ("a", "unknown image suffix ''"),
        (".", "unknown image suffix ''"),
        ("", "unknown image suffix ''"),
        ("folder.exr", "folder.exr: exists and is not a regular file"),
        ("file.exr/", "file.exr/: is not the name of a file"),
        ("missing/a.exr", "missing/a.exr: No such file or directory"),
        ("file.exr/a.exr", "file.exr/a.exr: Not a directory"),
        ("x" * 300 + ".exr", "File name too long"),
    ],
)
def test_outputs_are_refused_before_the_work(refuse: Refuse, tmp_path: Path, output: str, message: str) -> None:
    (tmp_path / "folder.exr").mkdir()
    (tmp_path / "file.exr").write_bytes(b"old")
    assert message in refuse("render", "never-read.xml", "-o", output)
    assert message in refuse("render", "never-read.xml", "-o", "fine.png", "-o", output)
    assert (tmp_path / "file.exr").read_bytes() == b"old"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "scene.xml: No such file or directory"),
        (b"", "not well-formed XML"),
        (b"# not XML", "scene.xml:1: not well-formed XML"),
        (b"\xff\xfe\x00", "not UTF-8 text"),
        (b"<scene version='3.0.0'>\n<shape type='torus'/></scene>", "scene.xml:2: unknown shape 'torus'; known: cube,"),
        (b"<scene version='3.0.0'>\n<shape type='sphere'><float name='r' value='1'/></shape></scene>", "center"),
        (
            b"<scene version='3.0.0'><shape type='ply'><string name='filename' value='/etc/passwd'/></shape></scene>",
            "/",
        ),
    ],
)
@pytest.mark.parametrize("command", ["render", "info"])
def test_scenes(refuse: Refuse, tmp_path: Path, content: bytes | None, message: str, command: str) -> None:
    if content is not None:
        (tmp_path / "scene.xml").write_bytes(content)
    output = ["-o", "a.exr"] if command == "render" else []
    error = refuse(command, "scene.xml", *output)
    assert "scene.xml" in error
    assert message in error


def test_a_missing_scene_is_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError) as refused:
        evenlight.load_scene(tmp_path / "scene.xml")
    assert refused.value.filename == str(tmp_path / "scene.xml")
    assert "os error" not in str(refused.value)


def test_folders_are_no_scenes(refuse: Refuse, tmp_path: Path) -> None:
    assert "not a regular file" in refuse("render", tmp_path, "-o", "a.exr")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["sobolev"], "'sobol', 'halton', 'independent'"),
        (["sobol", "--dims", "99999"], "1 to 21201 dimensions, not 99999"),
        (["sobol", "--dims", "0"], "at least 1, not 0"),
        (["sobol", "--scramble", "eggs"], "accepted: owen, owen_exact, linear, "),
        (["sobol", "--count", "1e3"], "'1e3' is not a whole number from 0 to"),
        (["sobol", "--count", "-1"], "'-1' is not a whole number"),
        (["sobol", "--count", "99999999999999999999"], "is not a whole number from 0 to"),
        (["sobol", "--seed", "-3"], "seed must be at least 0, not -3"),
        (["sobol", "-o", "x.txt"], "unknown table suffix '.txt'; known: .csv, .npy"),
        (["sobol", "-o", "missing/x.npy"], "missing/x.npy: No such file or directory"),
    ],
)
def test_points(refuse: Refuse, options: list[str], message: str) -> None:
    assert message in refuse("points", *options)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"spp": "64"}, "spp must be an integer, not str"),
        ({"seed": 0.5}, "seed must be an integer, not float"),
        ({"size": 64}, "size must be .width, height., not 64"),
        ({"size": (1, 2, 3)}, "size must be .width, height., not .1, 2, 3."),
        ({"size": (1.5, 2)}, "size: width must be an integer, not float"),
    ],
)
def test_wrong_types_are_named(scenes: Path, settings: dict[str, Any], message: str) -> None:
    with pytest.raises(TypeError, match=message):
        evenlight.render(scenes / "sky.xml", **settings)


MEDIUM = """<scene version="3.0.0">
  <shape type="sphere">
    <medium type="homogeneous" name="interior"/>
  </shape>
</scene>"""


def test_what_is_not_there_yet_is_an_error_or_a_warning_with_its_line(
    refuse: Refuse, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "scene.xml").write_text(MEDIUM)
    assert "scene.xml:3: participating media are not rendered yet" in refuse("render", "scene.xml", "-o", "a.exr")
    lenient = ["render", "scene.xml", "-o", "a.exr", *SMALL, "--spp", "4", "--lenient"]
    assert cli.main(lenient) == 0
    warning, summary = capsys.readouterr().err.splitlines()
    assert warning.startswith("evenlight: warning: ")
    assert warning.endswith("scene.xml:3: participating media are not rendered yet (ignored)")
    assert summary.startswith("done, 4x4")


def test_an_unknown_error_is_not_called_nan(tmp_path: Path, scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    single = ["--spp", "4", "--replicates", "1", "-o", str(tmp_path / "a.png")]
    assert cli.main(["render", str(scenes / "sky.xml"), *SMALL, *single]) == 0
    assert "mean relative error unknown (it takes 2 replicates)" in capsys.readouterr().err
