"""The arithmetic behind `make bench`, on numbers whose truth is known."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benches.errors import Reference, coverage, mean_squares
from benches.report import to_markdown

SHAPE = (40, 50, 3)


def references(generator: np.random.Generator) -> tuple[Reference, Reference]:
    """One good and one poor reference of the truth 1."""
    good, poor = (generator.normal(1, sigma, (10, *SHAPE)) for sigma in (0.01, 0.2))
    return Reference.from_replicates(good), Reference.from_replicates(poor)


def test_mean_squares_do_not_depend_on_the_reference() -> None:
    generator = np.random.default_rng(1)
    found = mean_squares(generator.normal(1, 0.1, (4, *SHAPE)), *references(generator))
    assert found["ours"] == pytest.approx(0.01, rel=0.03)
    assert found["theirs"] == pytest.approx(0.01, rel=0.03)


def test_coverage_allows_for_the_error_of_the_reference() -> None:
    generator = np.random.default_rng(2)
    found = coverage(generator.normal(1, 0.1, (4, 8, *SHAPE)), *references(generator))
    assert found["ours"] == pytest.approx(0.95, abs=0.01)
    assert found["theirs"] == pytest.approx(0.95, abs=0.01)


def test_exact_pixels_are_covered() -> None:
    ones = np.ones((8, *SHAPE))
    exact = Reference(np.ones(SHAPE), np.zeros(SHAPE), 10)
    assert coverage(ones[np.newaxis], exact, exact)["ours"] == 1.0


def test_the_report_is_a_pure_function_of_the_record() -> None:
    def run(cpu: float) -> dict[str, object]:
        return {"samples": 8e6, "cpu": cpu, "wall": cpu / 2, "peak_bytes": 100 << 20, "version": "3.9.1"}

    runs = {
        "evenlight sobol": [run(4.0), run(4.4), run(4.2)],
        "evenlight independent": [run(4.0)],
        "mitsuba llvm_ad_rgb": [run(8.4)],
        "mitsuba scalar_rgb": [{"failed": "no such variant"}],
    }
    record = {
        "machine": {"date": "today"},
        "width": 256,
        "spp": 32,
        "rounds": 3,
        "speed": [{"scene": "box", "runs": runs}],
        "points": [{"dims": 2, "count": 8, "rates": {"evenlight": 9e8, "scipy": 3e8}}],
    }
    text = to_markdown(record)
    assert text == to_markdown(record)
    row = "| box | 1.905 (3.810) | 0.952 (1.905) | – | 2.00 | – | 1.05 | 100 | 100 | – |"
    assert row in text
    assert "Not measured: box, mitsuba scalar_rgb: no such variant." in text
    assert "| 2 | 8 | 900 | 300 | 3.00 |" in text
    assert "Mitsuba 3.9.1." in text
