"""What is loaded, and when: a bare import is light, names come when they are asked for, and Ctrl-C ends it quietly."""

from __future__ import annotations

import inspect
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import evenlight
from conftest import ROOT

HEAVY = ("arviz_base", "arviz_stats", "jax", "matplotlib", "nutpie", "scipy", "torch", "tqdm", "vegas")


def output_of(program: str) -> str:
    """What a new interpreter prints."""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=100)
    assert done.returncode == 0, done.stderr
    return done.stdout


def loaded_by(program: str) -> set[str]:
    """Which modules a new interpreter has loaded after a program."""
    return set(output_of(f"{program}\nimport sys; print('\\n'.join(sys.modules))").splitlines())


@pytest.mark.parametrize("program", ["import evenlight", "import evenlight.cli", "import evenlight; dir(evenlight)"])
def test_a_bare_import_loads_no_room_and_no_large_library(program: str) -> None:
    loaded = loaded_by(program)
    assert "evenlight._core" in loaded
    assert loaded.isdisjoint(HEAVY)
    assert loaded.isdisjoint(f"evenlight.{name}" for name in evenlight.__all__)


@pytest.mark.parametrize("arguments", [["--version"], ["--help"]])
def test_the_program_says_what_it_is_without_loading_a_room(arguments: list[str]) -> None:
    program = f"""
from evenlight.cli import main
try:
    main({arguments})
except SystemExit as end:
    assert not end.code
"""
    assert loaded_by(program).isdisjoint([*HEAVY, "numpy", "evenlight.rendering", "evenlight.points"])


def test_a_render_needs_no_statistics_and_no_figures() -> None:
    program = f"import evenlight; evenlight.render({str(ROOT / 'scenes' / 'sky.xml')!r}, spp=4, size=(4, 4))"
    program += ".confidence_interval(0.95)"
    assert loaded_by(program).isdisjoint(["scipy.stats", "scipy.optimize", "matplotlib", "arviz_stats"])


@pytest.mark.parametrize("name", evenlight.__all__)
def test_every_name_works_after_a_bare_import(name: str) -> None:
    thing = getattr(evenlight, name)
    assert inspect.ismodule(thing) == (ROOT / "python" / "evenlight" / name).is_dir()
    if callable(thing):
        assert thing.__name__ == name


def test_rooms_work_after_a_bare_import_in_any_order() -> None:
    for name in ("mcmc", "smc", "multilevel", "lab", "quality"):
        assert output_of(f"import evenlight; print(evenlight.{name}.__name__)") == f"evenlight.{name}\n"
    # functions stay functions, whichever module was imported before
    for module, name in [("rendering", "render"), ("integration", "integrate"), ("bounces", "bounce_statistics")]:
        assert output_of(f"import evenlight.{module}; print(callable(evenlight.{name}))") == "True\n"


def test_names_that_do_not_exist_are_refused_as_usual() -> None:
    with pytest.raises(AttributeError, match=r"module 'evenlight' has no attribute 'raytrace'"):
        _ = evenlight.raytrace  # type: ignore[attr-defined]
    assert dir(evenlight) == sorted(evenlight.__all__)


@pytest.mark.skipif(os.name == "nt", reason="signals are POSIX")
@pytest.mark.parametrize("module", ["evenlight.points", "scipy.stats"])
def test_an_interrupt_while_loading_ends_quietly(tmp_path: Path, module: str) -> None:
    program = f"""
import signal, sys, time
signal.signal(signal.SIGINT, signal.default_int_handler)
from evenlight.cli import main

class Waiting:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            print("loading", flush=True)
            while True:
                time.sleep(0.02)

sys.meta_path.insert(0, Waiting())
sys.exit(main(["points", "sobol"]))
"""
    process = subprocess.Popen(
        [sys.executable, "-c", program], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "loading\n"
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
    finally:
        process.kill()
        process.wait()
    assert process.returncode == 130
    assert errors == "evenlight: interrupted\n"
