"""`evenlight integrate`: a test integrand with a known answer, by any rule and sequence."""

from __future__ import annotations

import argparse
import json
import math

from evenlight import integrands, points, rules
from evenlight.cli.warning_lines import warnings_as_lines
from evenlight.integration import integrate

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add = parser.add_argument
    add("integrand", choices=list(integrands.INTEGRANDS), metavar="INTEGRAND", help=", ".join(integrands.INTEGRANDS))
    add("--dims", type=int, default=5, help="dimensions (%(default)s)")
    add("--sequence", choices=list(points.SEQUENCES), default="sobol", help="the points (%(default)s)")
    add("--scramble", help="how to randomize (the sequence's own default)")
    add("--n", type=int, help="function values (65536, unless there is a tolerance)")
    add("--rtol", type=float, help="work up to this relative tolerance")
    add("--atol", type=float, help="work up to this absolute tolerance")
    add("--replicates", type=int, default=16, help="independent randomizations, for the error (%(default)s)")
    add("--level", type=float, default=0.95, help="of the interval and of the tolerance (%(default)s)")
    add("--max-n", type=int, default=2**24, help="the most function values for a tolerance (%(default)s)")
    add("--method", choices=["auto", *rules.RULES], default="auto", help="how values become an estimate (%(default)s)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add("--json", action="store_true", help="print everything as JSON")


def run(options: argparse.Namespace) -> int:
    """Integrate and print the estimate."""
    problem = integrands.build(options.integrand, options.dims)
    engine = points.build(options.sequence, options.dims, scramble=options.scramble, seed=options.seed)
    if options.n is None and options.rtol is None and options.atol is None:
        options.n = 2**16
    with warnings_as_lines():
        estimate = integrate(
            problem,
            engine,
            n=options.n,
            rtol=options.rtol,
            atol=options.atol,
            replicates=options.replicates,
            level=options.level,
            max_n=options.max_n,
            method=options.method,
        )
    low, high = estimate.confidence_interval(options.level)
    known = {"exact": problem.exact, "interval": None if math.isnan(low) else [low, high], "level": options.level}
    if options.json:
        print(json.dumps(estimate.to_dict() | known, indent=2))
    else:
        interval = "" if math.isnan(low) else f", {options.level:.4g} interval [{low:.8g}, {high:.8g}]"
        print(f"{estimate!r}{interval}, exact {problem.exact!r}")
    return 0
