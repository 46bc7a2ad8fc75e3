"""`make bench-points`: the speed of points against SciPy, QMCPy, sobol_burley and memory itself, in one run.

All contestants of a case take turns, so that a busy minute hits all alike; figures are medians over the turns. One
thread is measured in CPU time, several in wall time. Raw records go to out/bench-points.json, the tables to
benches/POINTS.md.
"""

from __future__ import annotations

import argparse
import json
import sys
import threading
import time
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import qmcpy
from scipy.stats import qmc

from benches.machine import describe
from benches.points_report import to_markdown
from benches.yardsticks import Yardsticks
from evenlight import points
from evenlight.quality import lattice_error

HERE = Path(__file__).resolve().parent
Record = dict[str, Any]
Contestants = dict[str, Callable[[], Any]]

MILLION = 1e6
SHAPES = ((8, 1 << 20), (64, 1 << 20), (2, 1 << 16), (8, 1 << 16), (1024, 1 << 16))
MOST_BURLEY = 256  # the dimensions of sobol_burley


class Bench:
    """The arrays, all touched before, and the library of yardsticks."""

    def __init__(self, rounds: int) -> None:
        self.rounds = rounds
        self.yardsticks = Yardsticks()
        most = max(dims * count for dims, count in SHAPES)
        self._arrays: dict[type, Any] = {np.float64: np.ones(most), np.float32: np.ones(most, np.float32)}
        # One of its own for memory's turn, which would send the others' from the caches.
        self._beside = np.ones(most)

    def out(self, dtype: type[np.float64 | np.float32], dims: int, count: int) -> Any:
        """Rows of an array that exists already."""
        return self._arrays[dtype][: dims * count].reshape(count, dims)

    def stream(self, dtype: type[np.float64 | np.float32], dims: int, count: int, threads: int = 1) -> None:
        """Write as many numbers with some threads, as fast as memory takes them."""
        together(self.yardsticks.stream, self._beside.view(dtype)[: dims * count], threads)

    def measure(self, contestants: Contestants, coordinates: int, wall: bool = False) -> Record:
        """Million coordinates per second of everyone, in every turn; the first turn warms up."""
        clock = time.perf_counter if wall else time.process_time
        rates: dict[str, list[float]] = {name: [] for name in contestants}
        for turn in range(self.rounds + 1):
            for name, run in contestants.items():
                start = clock()
                done = run()  # keeps a new array alive until the clock was read
                seconds = max(clock() - start, 1e-9)
                del done
                if turn > 0:
                    rates[name].append(coordinates / seconds / MILLION)
        return rates


def together(work: Callable[[Any], None], out: Any, threads: int) -> None:
    """Give every thread its part of an array."""
    if threads == 1:
        return work(out)
    workers = [threading.Thread(target=work, args=(part,)) for part in np.array_split(out, threads)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()


def measure_sobol(bench: Bench, dims: int, count: int) -> Record:
    """Sobol' points: into arrays that exist and into new ones."""
    single, double = (bench.out(dtype, dims, count) for dtype in (np.float32, np.float64))
    linear, owen = (points.Sobol(dims, scramble=scramble, seed=1) for scramble in ("linear", "owen"))
    scipy = qmc.Sobol(dims, scramble=True, rng=np.random.default_rng(1))
    theirs = qmcpy.DigitalNetB2(dims, seed=1)
    contestants: Contestants = {
        "memory f64": lambda: bench.stream(np.float64, dims, count),
        "evenlight linear f64": lambda: linear.points(0, count, double),
        "evenlight owen f64": lambda: owen.points(0, count, double),
        "memory f32": lambda: bench.stream(np.float32, dims, count),
        "evenlight linear f32": lambda: linear.points(0, count, single),
        "evenlight owen f32": lambda: owen.points(0, count, single),
        "new array": lambda: np.full((count, dims), 0.5),
        "evenlight linear, new array": lambda: linear.points(0, count),
        "evenlight owen, new array": lambda: owen.points(0, count),
        "SciPy LMS, new array": lambda: scipy.reset().random(count),
        "QMCPy LMS DS, new array": lambda: theirs(count),
    }
    if dims % 4 == 0 and dims <= MOST_BURLEY:
        contestants["sobol_burley f32"] = lambda: bench.yardsticks.burley(single)
    return {"dims": dims, "count": count, "rates": bench.measure(contestants, dims * count)}


def measure_threads(bench: Bench, dims: int, count: int) -> Record:
    """One thread and two, in wall time; what only computes, and another's generator, as controls."""
    contestants: Contestants = {}
    for workers in (1, 2):
        for dtype, name in ((np.float64, "f64"), (np.float32, "f32")):
            out = bench.out(dtype, dims, count)
            contestants[f"memory {name} {workers}"] = partial(bench.stream, dtype, dims, count, workers)
            for scramble in ("linear", "owen"):
                engine = points.Sobol(dims, scramble=scramble, seed=1)
                contestants[f"{scramble} {name} {workers}"] = partial(engine.points, 0, count, out, workers=workers)
        exact = points.Sobol(dims, scramble="owen_exact", seed=1)
        few = bench.out(np.float64, dims, count)[: count // 8]
        contestants[f"owen_exact f64, n / 8 {workers}"] = partial(exact.points, 0, count // 8, few, workers=workers)
        some = bench.out(np.float32, dims, count)[: count // 8]
        contestants[f"sobol_burley f32, n / 8 {workers}"] = partial(together, bench.yardsticks.burley, some, workers)
    rates = bench.measure(contestants, dims * count, wall=True)
    eighths = {name: [rate / 8 for rate in found] for name, found in rates.items() if "n / 8" in name}
    return {"dims": dims, "count": count, "rates": rates | eighths}


def measure_families(bench: Bench) -> list[Record]:
    """The slower families, each against the best that SciPy and QMCPy have; small counts where those take minutes."""
    dims, large, small = 64, 1 << 20, 1 << 14
    rng = np.random.default_rng(1)
    rivals: dict[str, dict[str, tuple[int, Callable[[int], Any]]]] = {
        "halton": {
            "SciPy": (1 << 17, lambda n: qmc.Halton(dims, rng=rng).random(n)),
            "QMCPy": (small, qmcpy.Halton(dims, seed=1)),
        },
        "faure": {"QMCPy": (67**2, qmcpy.Faure(dims, seed=1))},
        "latin_hypercube": {
            "SciPy": (1 << 17, lambda n: qmc.LatinHypercube(dims, rng=rng).random(n)),
            "QMCPy": (1 << 17, lambda n: qmcpy.LatinHypercube(dims, replications=1, seed=1)(n)),
        },
        "lattice": {"QMCPy": (large, qmcpy.Lattice(dims, seed=1, order="LINEAR"))},
        "korobov": {"QMCPy": (1 << 16, qmcpy.KorobovLattice(dims, seed=1))},
        "kronecker": {"QMCPy": (1 << 17, qmcpy.Kronecker(dims, seed=1, generating_vector="RICHTMYER"))},
        # nobody else makes them; this is what others would run their matrices on
        "polynomial_lattice": {"QMCPy net": (large, qmcpy.DigitalNetB2(dims, seed=1))},
    }
    records = []
    # SciPy's Halton points have one permutation for each place, so "digit_permutation" is like for like
    scrambles: dict[str, tuple[str | None, ...]] = {
        "halton": ("digit_permutation", "owen", "linear"),
        "faure": ("owen", "digit_permutation"),
        "polynomial_lattice": ("linear",),
    }
    pairs = [(name, theirs, scramble) for name, theirs in rivals.items() for scramble in scrambles.get(name, (None,))]
    for name, theirs, scramble in pairs:
        if name not in points.SEQUENCES:
            continue
        info = next(info for info in points.available() if info.name == name)
        options: dict[str, Any] = {"n": large} if "n" in info.options else {}
        engine = points.build(name, dims, scramble=scramble, seed=1, **options)
        out = bench.out(np.float64, dims, large)
        rates = bench.measure({"evenlight": partial(engine.points, 0, large, out)}, dims * large)
        for rival, (count, run) in theirs.items():
            rates |= bench.measure({f"{rival}, n = {count}": partial(run, count)}, dims * count)
        records.append({"family": f"{name} ({engine.scramble})", "dims": dims, "count": large, "rates": rates})
    return records


def measure_exact(bench: Bench) -> Record:
    """Full nested uniform scrambles, which QMCPy makes by a tree of Python objects: one turn of it is enough."""
    dims, count = 2, 1 << 16
    engine, out = points.Sobol(dims, scramble="owen_exact", seed=1), bench.out(np.float64, dims, count)
    rates = bench.measure({"evenlight": lambda: engine.points(0, count, out)}, dims * count)
    start = time.process_time()
    qmcpy.DigitalNetB2(dims, randomize="NUS", seed=1)(count)
    rates["QMCPy NUS"] = [dims * count / (time.process_time() - start) / MILLION]
    return {"family": "sobol (owen_exact)", "dims": dims, "count": count, "rates": rates}


def measure_nets(bench: Bench) -> list[Record]:
    """Other nets of the same engine, against QMCPy's interlaced Sobol' points and our own Sobol' points."""
    dims, count = 32, 1 << 20
    out = bench.out(np.float64, dims, count)
    sobol = points.Sobol(dims, scramble="linear", seed=1)
    records = []
    for order in (2, 3):
        theirs = qmcpy.DigitalNetB2(dims, seed=1, alpha=order)
        for scramble in ("linear", "owen"):
            engine = points.InterlacedSobol(dims, order=order, scramble=scramble, seed=1)
            contestants: Contestants = {
                "evenlight": partial(engine.points, 0, count, out),
                f"QMCPy LMS DS alpha = {order}": partial(theirs, count),
            }
            rates = bench.measure(contestants, dims * count)
            name = f"interlaced_sobol ({scramble}, order {order})"
            records.append({"family": name, "dims": dims, "count": count, "rates": rates})
    xing = points.NiederreiterXing(dims, scramble="linear", seed=1)
    rates = bench.measure(
        {
            "evenlight": partial(xing.points, 0, count, out),
            "evenlight Sobol' linear": partial(sobol.points, 0, count, out),
        },
        dims * count,
    )
    return [*records, {"family": "niederreiter_xing (linear)", "dims": dims, "count": count, "rates": rates}]


def measure_construction() -> Record:
    """CPU seconds for generating vectors of many points, and how their errors compare with a published vector."""
    dims, count = 100, 1 << 20
    weights = [1 / j**2 for j in range(1, dims + 1)]
    seconds = {}
    start = time.process_time()
    ours = points.construct_lattice(dims, count)
    seconds["lattice"] = time.process_time() - start
    for name, make, least in (
        ("lattice from 2^10 on", points.construct_lattice, 1 << 10),
        ("polynomial lattice", points.construct_polynomial_lattice, None),
    ):
        start = time.process_time()
        make(dims, count, least=least)
        seconds[name] = time.process_time() - start
    published = [int(number) for number in qmcpy.Lattice(dims).gen_vec[0]]
    ratio = lattice_error(ours, count, weights=weights) / lattice_error(published, count, weights=weights)
    return {"dims": dims, "count": count, "seconds": seconds, "error ratio": ratio}


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, keep the record, write the tables."""
    parser = argparse.ArgumentParser(prog="python -m benches.points", description=__doc__)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--report", type=Path, default=HERE / "POINTS.md")
    options = parser.parse_args(arguments)
    warnings.simplefilter("ignore")  # QMCPy's about its own defaults
    bench = Bench(options.rounds)
    versions = {name: version(name) for name in ("numpy", "scipy", "qmcpy")} | {"sobol_burley": "0.5.0"}
    record: Record = {"machine": describe() | versions, "rounds": options.rounds, "sobol": []}
    for dims, count in SHAPES:
        record["sobol"].append(measure_sobol(bench, dims, count))
        print(f"sobol, {dims} dimensions, {count} points", file=sys.stderr)
    record["threads"] = [measure_threads(bench, dims, count) for dims, count in SHAPES[:2]]
    print("threads", file=sys.stderr)
    record["families"] = [measure_exact(bench), *measure_nets(bench), *measure_families(bench)]
    record["construction"] = measure_construction()
    raw = HERE.parent / "out" / "bench-points.json"
    raw.parent.mkdir(exist_ok=True)
    raw.write_text(json.dumps(record, indent=1))
    options.report.write_text(to_markdown(record))
    print(options.report.read_text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
