"""The command line: what it writes, and errors of one line with exit code 2."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

import evenlight
from conftest import Run
from evenlight import cli


def error_of(done: subprocess.CompletedProcess[str]) -> str:
    """The message of a run that must have failed in the agreed way."""
    assert done.returncode == 2, done
    assert done.stderr.startswith("evenlight: error: ")
    assert done.stderr.count("\n") == 1, done.stderr
    return done.stderr


def test_version(evenlight_command: Run) -> None:
    done = evenlight_command("--version")
    assert (done.returncode, done.stdout) == (0, f"evenlight {evenlight.__version__}\n")


@pytest.mark.parametrize("command", [[], *([name] for name in cli.COMMANDS)])
def test_help_says_what_can_be_asked(evenlight_command: Run, command: list[str]) -> None:
    done = evenlight_command(*command, "--help")
    assert done.returncode == 0
    assert done.stdout.startswith(" ".join(["usage: evenlight", *command]))


@pytest.mark.parametrize("suffix", [".npy", ".csv"])
def test_points_are_those_of_the_package_to_the_bit(evenlight_command: Run, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"x{suffix}"
    options = ["--dims", "3", "--count", "100", "--start", "17", "--scramble", "owen", "--seed", "7"]
    done = evenlight_command("points", "sobol", *options, "-o", path)
    assert done.returncode == 0, done.stderr
    points = np.load(path) if suffix == ".npy" else np.loadtxt(path, delimiter=",")
    np.testing.assert_array_equal(points, evenlight.points.Sobol(3, scramble="owen", seed=7).points(17, 117))


def test_points_go_to_standard_output(evenlight_command: Run) -> None:
    done = evenlight_command("points", "halton", "--dims", "2", "--count", "5")
    assert done.returncode == 0
    points = np.array([[float(number) for number in line.split(",")] for line in done.stdout.splitlines()])
    np.testing.assert_array_equal(points, evenlight.points.build("halton", 2, seed=0).points(0, 5))


def test_no_points_make_an_empty_table(evenlight_command: Run, tmp_path: Path) -> None:
    assert evenlight_command("points", "sobol", "--dims", "4", "--count", "0", "-o", "x.npy").returncode == 0
    assert np.load(tmp_path / "x.npy").shape == (0, 4)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "COMMAND"),
        (["render", "scene.xml", "-o", "a.exr"], "scene.xml"),
    ],
)
def test_errors_are_one_line_also_in_a_process_of_its_own(
    evenlight_command: Run, tmp_path: Path, arguments: list[str], message: str
) -> None:
    assert message in error_of(evenlight_command(*arguments))
    assert not list(tmp_path.iterdir()), "nothing is left behind"


def test_render_writes_every_output(evenlight_command: Run, tmp_path: Path, scenes: Path) -> None:
    options = ["--spp", "8", "--replicates", "2", "--size", "12x8", "--seed", "5", "-D", "reflectance=0.25"]
    done = evenlight_command("render", scenes / "sky.xml", *options, "-o", "a.exr", "-o", "a.png", "-o", "a.npz")
    assert done.returncode == 0, done.stderr
    assert "mean relative error" in done.stderr
    with np.load(tmp_path / "a.npz") as archive, OpenEXR.File(str(tmp_path / "a.exr"), True) as file:
        assert archive["replicates"].shape == (2, 8, 12, 3)
        np.testing.assert_array_equal(file.channels()["R"].pixels, archive["color"][..., 0])
        np.testing.assert_allclose(archive["color"][-1], [[0.25, 0.2, 0.125]] * 12, rtol=0.2)
        metadata = json.loads(str(archive["metadata"]))
        assert file.header()["evenlight:seed"] == "5"
    assert metadata["seed"] == 5
    assert metadata["spp"] == 8
    assert metadata["parameters"] == {"reflectance": "0.25"}
    assert metadata["partial"] is False
    assert metadata["version"] == evenlight.__version__


def test_quiet_is_quiet(evenlight_command: Run, scenes: Path) -> None:
    options = ["--spp", "4", "--size", "4x4", "-o", "a.png", "--quiet"]
    done = evenlight_command("render", scenes / "sky.xml", *options)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_info_is_json(evenlight_command: Run, scenes: Path) -> None:
    done = evenlight_command("info", scenes / "demo.xml")
    assert done.returncode == 0, done.stderr
    assert isinstance(json.loads(done.stdout), dict)


def heed_interrupts() -> None:
    """Undo what a shell does to its background jobs, in which the tests may run: they ignore interrupts."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.skipif(os.name == "nt", reason="signals are POSIX")
@pytest.mark.parametrize("request_to_end", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_writes_what_there_is(tmp_path: Path, scenes: Path, request_to_end: signal.Signals) -> None:
    # a busy computer may take long to import all that is needed, and that is not what is interrupted here
    program = "import sys, evenlight.cli.render as _; from evenlight.cli import main; "
    program += "print('ready', flush=True); sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", program, "render", str(scenes / "demo.xml")]
    # So many samples that a single pixel would take minutes.
    command += ["--spp", str(1 << 31), "--size", "64x48", "-o", "a.npz", "-o", "a.exr", "-o", "a.png"]
    process = subprocess.Popen(
        command,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=heed_interrupts,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        time.sleep(3)
        assert process.poll() is None, process.stderr
        process.send_signal(request_to_end)
        _, errors = process.communicate(timeout=60)
    finally:
        process.kill()
        process.wait()
    assert process.returncode == 130, errors
    (line,) = errors.splitlines()
    assert line.startswith("interrupted: partial image, 64x48")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.exr", "a.npz", "a.png"]
    with np.load(tmp_path / "a.npz") as archive:
        assert json.loads(str(archive["metadata"]))["partial"] is True
        assert archive["color"].shape == (48, 64, 3)
    with OpenEXR.File(str(tmp_path / "a.exr"), True) as file:
        assert file.header()["evenlight:partial"] == "true"


def test_levels_are_summed_and_shown(evenlight_command: Run) -> None:
    call = "multilevel", "gbm", "european", "milstein", "strike=110", "--rmse", "0.2", "--seed", "3", "--level", "0.999"
    done = evenlight_command(*call)
    assert done.returncode == 0
    summary, header, *rows = done.stdout.splitlines()
    assert summary.startswith("Estimate(") and ", 0.999 interval [" in summary
    assert header.split() == ["level", "N", "mean", "variance", "cost", "kurtosis", "consistency"]
    assert [int(row.split()[0]) for row in rows] == list(range(len(rows)))
    plain = json.loads(evenlight_command("multilevel", "gbm", "asian", "--rmse", "0.2", "--json").stdout)
    assert plain["method"] == "mlmc"
    assert plain["interval"][0] < 5.76309 < plain["interval"][1]  # the price
    assert "known: european" in error_of(evenlight_command("multilevel", "gbm", "nothing", "--rmse", "0.2"))
    pairs = evenlight_command("multilevel", "diffusion_1d", "uniform", "--rmse", "0.01", "--method", "multi_index")
    assert "(0, 1)" in pairs.stdout
    wrong = evenlight_command("multilevel", "gbm", "--rmse", "0.2", "--method", "multi_index")
    assert "one direction only; multi_index takes diffusion_1d" in error_of(wrong)
