"""Measures of quality against SciPy and SALib, and how long exact star discrepancies take: `make bench-quality`."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from scipy.stats import qmc

from benches import quality_peers
from benches.machine import describe
from evenlight import points, quality

Record = dict[str, Any]
Array = npt.NDArray[np.float64]
StarMethod = Literal["auto", "threshold_accepting", "bracketing"]

HERE = Path(__file__).resolve().parent
SHAPES = ((5, 4096), (2, 4096), (10, 2048))
METHODS: tuple[Literal["CD", "WD", "MD", "L2-star"], ...] = ("CD", "WD", "MD", "L2-star")
REPEATS = 10  # of ours in a turn, for a time that can be measured
WANTED = 5.0  # times as fast as SciPy, at the first shape
STARS = (("sobol", 1, 1 << 20), ("sobol", 2, 1 << 17), ("sobol", 3, 1000), ("halton", 4, 300), ("sobol", 6, 100))


def seconds(call: Callable[[], object]) -> float:
    """The processor time of a call, all threads together."""
    start = time.process_time()
    call()
    return time.process_time() - start


def repeated(call: Callable[[], object]) -> None:
    """A call that is too short to be measured, several times."""
    for _ in range(REPEATS):
        call()


def measure_l2(d: int, n: int, rounds: int) -> Record:
    """Times of one shape, both programs in turn; ours is repeated until it takes long enough to be measured."""
    x = points.Sobol(d, seed=1).points(0, n)
    times: Record = {}
    for method in METHODS:
        ours, theirs = [], []
        difference = abs(quality.discrepancy(x, method) - float(qmc.discrepancy(x, method=method)))
        for _ in range(rounds):
            theirs.append(seconds(partial(qmc.discrepancy, x, method=method)))
            ours.append(seconds(partial(repeated, partial(quality.discrepancy, x, method))) / REPEATS)
        times[method] = {"evenlight": ours, "SciPy": theirs, "difference": difference}
    return {"d": d, "n": n, "times": times}


def measure_star(name: str, d: int, n: int) -> Record:
    """The exact star discrepancy of a set, what was expected of it, and the bounds."""
    x = points.build(name, d, seed=1).points(0, n)
    found: list[quality.StarDiscrepancy] = []
    taken = seconds(partial(_star, x, "auto", found))
    star = found[0]
    case = {
        "points": name,
        "d": d,
        "n": n,
        "value": star.value,
        "kind": star.kind,
        "method": star.method,
        "seconds": taken,
    }
    if d > 2:
        case["steps"] = quality.star_discrepancy_cost(x)
        bounds: tuple[StarMethod, ...] = ("threshold_accepting", "bracketing")
        for method in bounds:
            taken = seconds(partial(_star, x, method, found))
            case[method] = {"value": found[-1].value, "seconds": taken}
    return case


def _star(x: Array, method: StarMethod, found: list[quality.StarDiscrepancy]) -> None:
    """Compute and keep, exactly if the method leaves the choice."""
    found.append(quality.star_discrepancy(x, method, limit=float("inf")))


def to_markdown(record: Record) -> str:
    """The tables of a record: a pure function."""
    lines = [
        "# Quality",
        "",
        "Written by `make bench-quality`; figures of one run on one machine. Ratios are what counts.",
    ]
    lines += ["", "; ".join(f"{key}: {value}" for key, value in record["machine"].items()), ""]
    peers = quality_peers.to_markdown(record["indices"], record["sorts"])
    return "\n".join([*lines, *_l2(record), "", *_stars(record), "", *peers]) + "\n"


def _l2(record: Record) -> Iterator[str]:
    yield "## L2 family: times as fast as SciPy"
    yield ""
    yield (
        f"One thread each; ratios of the medians of {record['rounds']} turns of processor time, and of the best turns "
        f"in brackets; wanted: {WANTED:g} at d = 5, n = 4096. Largest difference of the values: "
        f"{_difference(record):.0e}."
    )
    yield ""
    yield f"| | {' | '.join(METHODS)} |"
    yield "|---|" + "---|" * len(METHODS)
    for case in record["l2"]:
        cells = [_ratio(case["times"][method]) for method in METHODS]
        yield f"| d = {case['d']}, n = {case['n']} | {' | '.join(cells)} |"


def _difference(record: Record) -> float:
    return float(max(times["difference"] for case in record["l2"] for times in case["times"].values()))


def _ratio(times: Record) -> str:
    ours, theirs = times["evenlight"], times["SciPy"]
    return f"{median(theirs) / median(ours):.3g} ({min(theirs) / min(ours):.3g})"


def _stars(record: Record) -> Iterator[str]:
    yield "## Star discrepancy: seconds of one processor"
    yield ""
    yield "| points | d | n | exact | method | seconds | expected steps | lower bound (seconds) | upper (seconds) |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for case in record["stars"]:
        bounds = [_bound(case.get(method)) for method in ("threshold_accepting", "bracketing")]
        steps = f"{case['steps']:.1e}" if "steps" in case else "–"
        head = f"{case['points']} | {case['d']} | {case['n']} | {case['value']:.6f} | {case['method']}"
        yield f"| {head} | {case['seconds']:.2g} | {steps} | {' | '.join(bounds)} |"


def _bound(bound: Record | None) -> str:
    return f"{bound['value']:.6f} ({bound['seconds']:.2g})" if bound else "–"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, keep the record, write the tables."""
    parser = argparse.ArgumentParser(prog="python -m benches.quality", description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--particles", help="a Python that has the package particles, to sort clouds with")
    parser.add_argument("--report", type=Path, default=HERE / "QUALITY.md")
    options = parser.parse_args(arguments)
    record: Record = {"machine": describe(), "rounds": options.rounds}
    record["l2"] = [measure_l2(d, n, options.rounds) for d, n in SHAPES]
    print("L2 family", file=sys.stderr)
    record["stars"] = [measure_star(*case) for case in STARS]
    record["indices"] = quality_peers.measure_indices(1 << 14)
    record["sorts"] = quality_peers.measure_sorts(options.rounds, options.particles)
    raw = HERE.parent / "out" / "bench-quality.json"
    raw.parent.mkdir(exist_ok=True)
    raw.write_text(json.dumps(record, indent=1))
    options.report.write_text(to_markdown(record))
    print(options.report.read_text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
