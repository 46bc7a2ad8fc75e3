"""The command line: `evenlight render | points | integrate | multilevel | info`. One command, one file.

A command's file is imported when the command is called, so that the others cost nothing.
"""

from __future__ import annotations

import argparse
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

import evenlight
from evenlight.cli.exit_codes import EXIT_ERROR, EXIT_INTERRUPTED

__all__ = ["COMMANDS", "main"]

COMMANDS = {
    "render": "render a Mitsuba 3 scene",
    "points": "write (randomized) points",
    "integrate": "integrate a test function",
    "multilevel": "estimate a model by its levels",
    "info": "say what a scene contains",
}
"""The files of this folder, each with `add_arguments(parser)` and `run(options)`, and what they do."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0, 2 after an error, 130 after Ctrl-C or a request to end."""
    previous = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        options = _parser().parse_args(arguments)
        return int(options.run(options))
    except KeyboardInterrupt:
        print("evenlight: interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED
    except BrokenPipeError:  # the reader of `-o -` has seen enough
        sys.stderr.close()
        return EXIT_ERROR
    except (ValueError, TypeError, OSError, MemoryError) as error:
        print(f"evenlight: error: {_one_line(error)}", file=sys.stderr)
        return EXIT_ERROR
    finally:
        signal.signal(signal.SIGTERM, previous)


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line, and which learns the arguments of its command when they are to be parsed."""

    command: str | None = None

    def parse_known_args(self, *arguments: Any, **settings: Any) -> Any:
        """As argparse has it."""
        if self.command is not None:
            module = import_module(f"evenlight.cli.{self.command}")
            self.command = None
            module.add_arguments(self)
            self.set_defaults(run=module.run)
        return super().parse_known_args(*arguments, **settings)

    def error(self, message: str) -> NoReturn:
        self.exit(EXIT_ERROR, f"evenlight: error: {message} (see {self.prog} --help)\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="evenlight", description="Images whose every pixel carries an honest standard error.")
    parser.add_argument("--version", action="version", version=f"evenlight {evenlight.__version__}")
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND", parser_class=_Parser)
    for name, purpose in COMMANDS.items():
        commands.add_parser(name, help=purpose, description=f"{purpose[0].upper()}{purpose[1:]}.").command = name
    return parser


def _one_line(error: BaseException) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{Path(str(error.filename))}: {error.strerror}"
    return " ".join(str(error).split()) or type(error).__name__
