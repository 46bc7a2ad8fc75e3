"""Sobol' indices against SALib, and clouds in Hilbert order against NumPy and the package particles."""

from __future__ import annotations

import json
import subprocess
import time
from collections.abc import Callable, Iterator
from functools import partial
from statistics import median
from typing import Any

import numpy as np
import numpy.typing as npt

from evenlight import quality, warp

Record = dict[str, Any]
Array = npt.NDArray[np.float64]

CLOUDS = ((1, 4096), (2, 4096), (4, 4096), (8, 4096), (3, 1_000_000))
SMALL = 10**5  # clouds up to this size are sorted several times in a turn
REPEATS = 20

# For an interpreter of its own, as particles needs an older NumPy than we: median processor times in seconds.
PARTICLES = """
import json, sys, time
import numpy as np
from particles.hilbert import hilbert_sort
times = []
for d, n in json.loads(sys.argv[1]):
    x = np.random.default_rng(d).random((n, d))
    hilbert_sort(x[:10])
    turns = []
    for _ in range(5):
        start = time.process_time()
        hilbert_sort(x)
        turns.append(time.process_time() - start)
    times.append(sorted(turns)[2])
print(json.dumps(times))
"""


def ishigami(x: Array) -> Array:
    """T. Ishigami and T. Homma 1990, with a = 7 and b = 0.1."""
    angle = np.pi * (2 * x - 1)
    found: Array = np.sin(angle[:, 0]) + 7 * np.sin(angle[:, 1]) ** 2 + 0.1 * angle[:, 2] ** 4 * np.sin(angle[:, 0])
    return found


def measure_indices(n: int) -> Record:
    """Indices of first and total order of Ishigami's function from both programs, with as many evaluations."""
    from SALib.analyze import sobol as analysis
    from SALib.sample import sobol as sampling

    problem = {"num_vars": 3, "names": ["1", "2", "3"], "bounds": [[0.0, 1.0]] * 3}
    x = sampling.sample(problem, n, calc_second_order=False, seed=1)
    theirs = analysis.analyze(problem, ishigami(x), calc_second_order=False, seed=1)
    ours = quality.sobol_indices(ishigami, 3, n=n // 16, replicates=16, seed=1)
    indices = np.concatenate([ours.first_order, ours.total_order])
    errors = np.concatenate([ours.first_order_error, ours.total_order_error])
    values = np.concatenate([theirs["S1"], theirs["ST"]])
    stated = np.concatenate([theirs["S1_conf"], theirs["ST_conf"]]) / 1.959964
    apart = np.abs(indices - values) / np.hypot(errors, stated)
    return {
        "evaluations": len(x),
        "apart": float(apart.max()),
        "ours": indices.tolist(),
        "SALib": values.tolist(),
        "error": float(errors.max()),
        "SALib_error": float(stated.max()),
    }


def measure_sorts(rounds: int, python: str | None) -> list[Record]:
    """Times to sort clouds, in turns with NumPy's argsort of the finished numbers on the curve."""
    theirs: list[float | None] = [None] * len(CLOUDS)
    if python is not None:
        command = [python, "-c", PARTICLES, json.dumps(CLOUDS)]
        theirs = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    return [_sort(d, n, rounds) | {"particles": other} for (d, n), other in zip(CLOUDS, theirs, strict=True)]


def _sort(d: int, n: int, rounds: int) -> Record:
    x = np.random.default_rng(d).random((n, d))
    numbers = warp.hilbert_inverse(x)
    unit = [[0.0] * d, [1.0] * d]
    repeats = REPEATS if n <= SMALL else 1
    calls: dict[str, Callable[[], object]] = {
        "evenlight": partial(warp.hilbert_sort, x, unit),
        "argsort": partial(np.argsort, numbers),
    }
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            start = time.process_time()
            for _ in range(repeats):
                call()
            times[name].append((time.process_time() - start) / repeats)
    return {"d": d, "n": n} | {name: median(turns) for name, turns in times.items()}


def to_markdown(indices: Record, sorts: list[Record]) -> Iterator[str]:
    """The tables: a pure function."""
    yield "## Sobol' indices: agreement with SALib"
    yield ""
    yield (
        f"Ishigami's function, {indices['evaluations']} evaluations each, six indices: at most {indices['apart']:.2g} "
        f"combined standard errors apart. Largest standard error: {indices['error']:.1e}, SALib's by bootstrap "
        f"{indices['SALib_error']:.1e}."
    )
    yield ""
    yield "## Clouds in Hilbert order"
    yield ""
    yield (
        "One thread; microseconds of processor time, medians. `argsort` is NumPy's, of numbers on the curve that are "
        "known already; `particles` computes them too."
    )
    yield ""
    yield "| d | n | hilbert_sort | argsort alone | particles | particles / ours |"
    yield "|---|---|---|---|---|---|"
    for case in sorts:
        times = [case["evenlight"], case["argsort"], case["particles"]]
        cells = ["–" if seconds is None else f"{seconds * 1e6:.3g}" for seconds in times]
        ratio = "–" if times[2] is None else f"{times[2] / times[0]:.3g}"
        yield f"| {case['d']} | {case['n']} | {' | '.join(cells)} | {ratio} |"
