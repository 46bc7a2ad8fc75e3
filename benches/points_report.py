"""The record of a bench run of points as Markdown: a pure function, numbers in, text out."""

from __future__ import annotations

from collections.abc import Iterator
from statistics import median
from typing import Any

__all__ = ["to_markdown"]

Record = dict[str, Any]
Rates = dict[str, list[float]]

# What is compared with what, and the least ratio that we want at 2^20 points.
RATIOS: tuple[tuple[str, str, str, float], ...] = (
    ("linear f64 ÷ memory", "evenlight linear f64", "memory f64", 0.7),
    ("linear f32 ÷ memory", "evenlight linear f32", "memory f32", 0.7),
    ("linear f64 ÷ SciPy LMS", "evenlight linear f64", "SciPy LMS, new array", 5),
    ("owen f64 ÷ SciPy LMS", "evenlight owen f64", "SciPy LMS, new array", 4),
    ("owen f32 ÷ sobol_burley", "evenlight owen f32", "sobol_burley f32", 5),
    ("linear ÷ SciPy LMS, both new arrays", "evenlight linear, new array", "SciPy LMS, new array", 1),
    ("linear ÷ any new array", "evenlight linear, new array", "new array", 0.7),
)
LARGE = 1 << 20


def to_markdown(record: Record) -> str:
    """The tables of a record."""
    lines = [
        "# Points",
        "",
        "Written by `make bench-points`; figures of one run on one machine. Ratios are what counts.",
    ]
    lines += ["", "; ".join(f"{key}: {value}" for key, value in record["machine"].items()), ""]
    for section in (_ratios, _sobol, _threads, _families, _construction):
        lines += [*section(record), ""]
    return "\n".join(lines).rstrip() + "\n"


def _ratios(record: Record) -> Iterator[str]:
    cases = [case for case in record["sobol"] if case["count"] == LARGE]
    yield "## Sobol' points: ratios"
    yield ""
    yield (
        "2^20 points; ratios of medians, and of the best turns in brackets. *memory* writes one number everywhere "
        "with the widest non-temporal stores: the limit for any generator. *linear* is a random linear scramble with a "
        "digital shift, *owen* the hashed nested uniform scramble; both into arrays that were touched before. "
        "`sobol_burley` is compiled for this processor and makes four dimensions at a time."
    )
    yield ""
    yield f"| | wanted | {' | '.join('d = ' + str(case['dims']) for case in cases)} |"
    yield "|---|---|" + "---|" * len(cases)
    for name, ours, theirs, wanted in RATIOS:
        yield f"| {name} | {wanted:g} | {' | '.join(_ratio(case['rates'], ours, theirs) for case in cases)} |"


def _sobol(record: Record) -> Iterator[str]:
    cases = record["sobol"]
    yield "## Sobol' points: million coordinates per CPU-second"
    yield ""
    yield f"Medians of {record['rounds']} turns (and the best)."
    yield ""
    yield f"| | {' | '.join(_shape(case) for case in cases)} |"
    yield "|---|" + "---|" * len(cases)
    names = dict.fromkeys(name for case in cases for name in case["rates"])
    for name in names:
        yield f"| {name} | {' | '.join(_rate(case['rates'], name) for case in cases)} |"


def _threads(record: Record) -> Iterator[str]:
    yield "## Two threads"
    yield ""
    yield (
        "Million coordinates per second of wall time, into arrays that were touched before, with one thread and with "
        "two. The ratio is that of the best turns, because others may have used the second processor. No generator can "
        "be faster than memory, whose row says what this machine has for two; `sobol_burley` and `owen_exact` only "
        "compute, and say what a second processor is worth when memory is idle."
    )
    yield ""
    yield "| | shape | one | two | ratio |"
    yield "|---|---|---|---|---|"
    for case in record["threads"]:
        for name in dict.fromkeys(name.rpartition(" ")[0] for name in case["rates"]):
            cells = [_rate(case["rates"], f"{name} {workers}") for workers in (1, 2)]
            one, two = (max(case["rates"][f"{name} {workers}"]) for workers in (1, 2))
            yield f"| {name} | {_shape(case)} | {' | '.join(cells)} | {two / one:.2f} |"


def _families(record: Record) -> Iterator[str]:
    yield "## Other families: million coordinates per CPU-second"
    yield ""
    yield "| | shape | evenlight | others | ratio to the best of them |"
    yield "|---|---|---|---|---|"
    for case in record["families"]:
        rates = case["rates"]
        others = {name: median(found) for name, found in rates.items() if name != "evenlight"}
        listed = ", ".join(f"{name}: {rate:.3g}" for name, rate in others.items())
        ratio = _ratio(rates, "evenlight", max(others, key=others.__getitem__))
        yield f"| {case['family']} | {_shape(case)} | {_rate(rates, 'evenlight')} | {listed} | {ratio} |"


def _construction(record: Record) -> Iterator[str]:
    made = record["construction"]
    yield "## Construction, component by component"
    yield ""
    yield (
        f"CPU seconds for {_shape(made)} and weights 1/j². The lattice's squared error is {made['error ratio']:.3g} "
        "times that of F. Y. Kuo's `lattice-33002`, which serves 2^10 to 2^20 points, in this criterion."
    )
    yield ""
    yield "| | seconds |"
    yield "|---|---|"
    for name, seconds in made["seconds"].items():
        yield f"| {name} | {seconds:.1f} |"


def _shape(case: Record) -> str:
    return f"d = {case['dims']}, n = 2^{case['count'].bit_length() - 1}"


def _rate(rates: Rates, name: str) -> str:
    found = rates.get(name)
    return f"{median(found):.0f} ({max(found):.0f})" if found else "–"


def _ratio(rates: Rates, ours: str, theirs: str) -> str:
    if not rates.get(ours) or not rates.get(theirs):
        return "–"
    return f"{median(rates[ours]) / median(rates[theirs]):.3g} ({max(rates[ours]) / max(rates[theirs]):.3g})"
