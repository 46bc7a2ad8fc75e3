"""Files are written whole or not at all."""

from __future__ import annotations

import stat
from pathlib import Path

import pytest

from evenlight import files


def test_a_failed_block_keeps_the_old_file_and_leaves_no_other(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    path.write_bytes(b"old")
    with pytest.raises(RuntimeError, match="half way"), files.replacing(path) as file:
        file.write(b"half of the ne")
        raise RuntimeError("half way")
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_finished_block_replaces_the_file(tmp_path: Path) -> None:
    path = tmp_path / "a.bin"
    plain = tmp_path / "plain.bin"
    plain.write_bytes(b"")
    for content in (b"first", b"second"):
        with files.replacing(path) as file:
            file.write(content)
        assert path.read_bytes() == content
    assert stat.S_IMODE(path.stat().st_mode) == stat.S_IMODE(plain.stat().st_mode)


def test_a_link_keeps_pointing_where_it_points(tmp_path: Path) -> None:
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(b"old")
    link.symlink_to(target)
    with files.replacing(link) as file:
        file.write(b"new")
    assert link.is_symlink()
    assert target.read_bytes() == b"new"


def test_unwritable_places_are_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no-such-folder"):
        files.check_writable(tmp_path / "no-such-folder" / "a.exr")
    with pytest.raises(OSError, match="not a regular file"):
        files.check_writable(tmp_path)
    files.check_writable(tmp_path / "a.exr")
    assert not list(tmp_path.iterdir())
