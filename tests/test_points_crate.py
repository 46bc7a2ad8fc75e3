"""The points crate alone: without the standard library, and from C."""

from __future__ import annotations

import subprocess

import pytest

from conftest import ROOT


@pytest.mark.parametrize("features", [["--no-default-features"], []], ids=["without std", "with std"])
def test_the_crate_compiles_alone_without_warnings(features: list[str]) -> None:
    # Without the feature `std` the crate is `#![no_std]`, and any use of the standard library is an error.
    command = ["cargo", "check", "--locked", "--quiet", "--release", "-p", "evenlight-points", *features]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
