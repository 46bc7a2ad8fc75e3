"""`evenlight info`: what a scene contains, as JSON."""

from __future__ import annotations

import argparse
import json

from evenlight.cli.scene_arguments import add_scene, load

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_scene(parser)


def run(options: argparse.Namespace) -> int:
    """Print what the scene contains."""
    print(json.dumps(load(options).info(), indent=2, ensure_ascii=False, default=str))
    return 0
