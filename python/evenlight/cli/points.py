"""`evenlight points`: any rows of a sequence as a table."""

from __future__ import annotations

import argparse

from evenlight import points, tables

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add = parser.add_argument
    names = [sequence.name for sequence in points.available()]
    add("sequence", choices=names, metavar="SEQUENCE", help=", ".join(names))
    add("--dims", type=int, default=2, help="dimensions (%(default)s)")
    add("--count", type=_natural, default=1024, help="rows (%(default)s)")
    add("--start", type=_natural, default=0, help="index of the first row (%(default)s)")
    add("--scramble", help="how to randomize (the sequence's own default)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add(
        "-O",
        "--option",
        action="append",
        default=[],
        type=_option,
        metavar="NAME=VALUE",
        help="what the sequence asks besides, such as base=3; a list as generator=1,182667",
    )
    add("-o", "--output", default="-", metavar="FILE", help=".npy, .csv, or - for CSV on standard output")


def run(options: argparse.Namespace) -> int:
    """Write the points."""
    if options.dims < 1:
        raise ValueError(f"--dims must be at least 1, not {options.dims}")
    settings = dict(options.option)
    if points.SEQUENCES[options.sequence].finite:
        settings.setdefault("n", options.start + options.count)
    engine = points.build(options.sequence, options.dims, scramble=options.scramble, seed=options.seed, **settings)
    tables.write(options.output, engine, range(options.start, options.start + options.count), options.dims)
    return 0


def _natural(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and int(text) < 2**63):
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from 0 to 2^63 - 1")
    return int(text)


def _option(text: str) -> tuple[str, int | list[int]]:
    name, equals, value = text.partition("=")
    numbers = value.split(",")
    if not (name.isidentifier() and equals and all(number.isascii() and number.isdecimal() for number in numbers)):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=NUMBER or NAME=NUMBER,NUMBER,…")
    return name, int(value) if len(numbers) == 1 else [int(number) for number in numbers]
