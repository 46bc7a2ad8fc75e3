"""The record of a bench run as Markdown: a pure function, numbers in, text out."""

from __future__ import annotations

from collections.abc import Iterator
from statistics import median
from typing import Any

__all__ = ["to_markdown"]

Record = dict[str, Any]
SCALAR, LLVM = "mitsuba scalar_rgb", "mitsuba llvm_ad_rgb"
SOBOL, INDEPENDENT = "evenlight sobol", "evenlight independent"
MEGA = 1e6
MEBI = 1 << 20


def to_markdown(record: Record) -> str:
    """The tables of a record, whatever parts it has."""
    sections = {"speed": _speed, "errors": _errors, "points": _points}
    lines = ["# Results", "", "Written by `make bench`; figures of one run on one machine. Ratios are what counts.", ""]
    lines += ["; ".join(f"{key}: {value}" for key, value in record["machine"].items()), ""]
    for name, section in sections.items():
        if name in record:
            lines += [*section(record), ""]
    return "\n".join(lines).rstrip() + "\n"


def _speed(record: Record) -> Iterator[str]:
    yield "## Speed and memory"
    yield ""
    yield (
        f"Same scene, width {record['width']}, {record['spp']} samples per pixel, the scene's own depth, box filter; "
        f"medians of {record['rounds']} turns, warm. M/CPU-s: million samples per CPU-second; M/s: per second of wall "
        "clock with all cores. Ratios are of samples per CPU-second, ours (sobol) to theirs; memory is the peak of "
        f"the process.{_versions(record)}"
    )
    yield ""
    yield (
        "| scene | evenlight sobol M/CPU-s (M/s) | Mitsuba llvm | Mitsuba scalar | ÷ llvm | ÷ scalar | "
        "sobol cost ÷ independent | MiB, ours | MiB, llvm | MiB, scalar |"
    )
    yield "|---|---|---|---|---|---|---|---|---|---|"
    for scene in record["speed"]:
        runs = scene["runs"]
        cells = [_rates(runs.get(name, [])) for name in (SOBOL, LLVM, SCALAR)]
        ratios = [_ratio(_rate(runs, SOBOL), _rate(runs, rival)) for rival in (LLVM, SCALAR)]
        cost = _ratio(_rate(runs, INDEPENDENT), _rate(runs, SOBOL))
        memory = [_memory(runs.get(name, [])) for name in (SOBOL, LLVM, SCALAR)]
        yield f"| {' | '.join([scene['scene'], *cells, *ratios, cost, *memory])} |"
    failures = {
        f"{scene['scene']}, {name}: {run['failed']}"
        for scene in record["speed"]
        for name, runs in scene["runs"].items()
        for run in runs
        if "failed" in run
    }
    for failure in sorted(failures):
        yield f"\nNot measured: {failure}."


def _errors(record: Record) -> Iterator[str]:
    errors = record["errors"]
    yield "## Error at equal samples"
    yield ""
    if "failed" in errors:
        yield f"Not measured: {errors['failed']}."
        return
    yield (
        f"`{errors['scene']}`, 64 samples per pixel, mean of four seeds; mean squared error ± standard error against a "
        f"reference of ours ({errors['reference_spp']} samples per pixel) and against Mitsuba's, the reference's own "
        "variance taken off. *Better than independent* compares with the same renderer's independent sampler."
    )
    yield ""
    yield "| sampler | samples | MSE, our reference | MSE, their reference | better than independent |"
    yield "|---|---|---|---|---|"
    squares = errors["squares"]
    for name, found in squares.items():
        if "failed" in found:
            yield f"| {name} | – | not measured: {found['failed']} | – | – |"
            continue
        plain = squares.get(f"{name.split()[0]} independent", {}).get("ours")
        pairs = [f"{found[key]:.3e} ± {found[key + '_error']:.0e}" for key in ("ours", "theirs")]
        yield f"| {name} | {found['spp']} | {' | '.join(pairs)} | {_ratio(plain, found['ours'])} |"
    yield ""
    yield (
        "How many of (pixel, channel) are held by 95 % intervals from 8 replicates (`Film.confidence_interval`, "
        "allowing for the reference's own error), over four seeds. The mean of few samples is skewed, because bright "
        "paths are rare: Student's t alone makes intervals that are too short."
    )
    yield ""
    yield "| spp | our reference | Mitsuba's reference | lowest and highest seed | Student's t, our reference |"
    yield "|---|---|---|---|---|"
    for spp, found in errors["coverage"].items():
        if "failed" in found:
            yield f"| {spp} | not measured: {found['failed']} | – | – | – |"
            continue
        extremes = f"{found['theirs_lowest']:.2%}, {found['theirs_highest']:.2%}"
        yield f"| {spp} | {found['ours']:.2%} | {found['theirs']:.2%} | {extremes} | {found['ours_plain']:.2%} |"


def _points(record: Record) -> Iterator[str]:
    yield "## Points"
    yield ""
    yield (
        "Scrambled Sobol' points into a new array, million coordinates per CPU-second; ours with 64-bit digits and a "
        "nested uniform (Owen) scramble, SciPy's with 30 bits and a linear matrix scramble."
    )
    yield ""
    yield "| dimensions | points | evenlight | SciPy | ratio |"
    yield "|---|---|---|---|---|"
    for case in record["points"]:
        if "failed" in case:
            yield f"| {case['dims']} | {case['count']} | not measured: {case['failed']} | – | – |"
            continue
        ours, theirs = case["rates"]["evenlight"], case["rates"]["scipy"]
        cells = [f"{ours / MEGA:.0f}", f"{theirs / MEGA:.0f}", _ratio(ours, theirs)]
        yield f"| {case['dims']} | {case['count']} | {' | '.join(cells)} |"


def _good(runs: list[Record]) -> list[Record]:
    return [run for run in runs if "failed" not in run]


def _rate(runs: dict[str, list[Record]], name: str) -> float | None:
    """Samples per CPU-second, the median."""
    rates = [run["samples"] / run["cpu"] for run in _good(runs.get(name, []))]
    return median(rates) if rates else None


def _rates(runs: list[Record]) -> str:
    good = _good(runs)
    if not good:
        return "–"
    per_cpu, per_wall = (median(run["samples"] / run[clock] for run in good) / MEGA for clock in ("cpu", "wall"))
    return f"{per_cpu:.3f} ({per_wall:.3f})"


def _memory(runs: list[Record]) -> str:
    good = _good(runs)
    return f"{median(run['peak_bytes'] for run in good) / MEBI:.0f}" if good else "–"


def _ratio(ours: float | None, theirs: float | None) -> str:
    return f"{ours / theirs:.2f}" if ours and theirs else "–"


def _versions(record: Record) -> str:
    found = {
        run["version"]
        for scene in record["speed"]
        for name, runs in scene["runs"].items()
        if name in (SCALAR, LLVM)
        for run in _good(runs)
    }
    return f" Mitsuba {', '.join(sorted(found))}." if found else ""
