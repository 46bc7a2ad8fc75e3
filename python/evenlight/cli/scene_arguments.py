"""What all commands that read a scene share: where it is, how it is read, and its warnings."""

from __future__ import annotations

import argparse
import sys

from evenlight import _core
from evenlight.rendering import Scene, read_scene

__all__ = ["add_scene", "load"]


def add_scene(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that say which scene, and how to read it."""
    add = parser.add_argument
    add("scene", metavar="SCENE", help="a Mitsuba 3 XML file")
    add(
        "-D",
        "--define",
        action="append",
        type=_definition,
        default=[],
        metavar="NAME=VALUE",
        help="$NAME in it",
    )
    add("--lenient", action="store_true", help="unknown plugins and parameters are warnings")
    add("--allow-outside", action="store_true", help="allow files outside the scene's folder")
    add(
        "--kernel",
        choices=_core.kernels(),
        default="auto",
        help="what intersects rays (%(default)s)",
    )


def load(options: argparse.Namespace) -> Scene:
    """Read the scene, and print what a lenient reader substituted."""
    scene = read_scene(options.scene, dict(options.define), options.lenient, options.allow_outside, options.kernel)
    for warning in scene.warnings:
        print(f"evenlight: warning: {warning}", file=sys.stderr)
    return scene


def _definition(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name and equals):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=VALUE")
    return name, value
