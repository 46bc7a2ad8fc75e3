"""The tables of `make bench-points`, from numbers whose ratios are known."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benches.points_report import to_markdown


def test_the_report_is_a_pure_function_of_the_record() -> None:
    rates = {"memory f64": [2000.0, 1900.0, 2400.0], "evenlight linear f64": [1600.0, 1000.0, 1800.0]}
    threads = {"owen f64 1": [10.0, 20.0], "owen f64 2": [35.0, 15.0]}
    families = {"evenlight": [80.0], "SciPy": [4.0], "QMCPy": [8.0, 10.0, 9.0]}
    record = {
        "machine": {"date": "today"},
        "rounds": 3,
        "sobol": [{"dims": 8, "count": 1 << 20, "rates": rates}, {"dims": 2, "count": 1 << 16, "rates": {}}],
        "threads": [{"dims": 8, "count": 1 << 20, "rates": threads}],
        "families": [{"family": "halton (owen)", "dims": 64, "count": 1 << 20, "rates": families}],
        "construction": {"dims": 100, "count": 1 << 20, "seconds": {"lattice": 2.04}, "error ratio": 0.25},
    }
    text = to_markdown(record)
    assert text == to_markdown(record)
    assert "| linear f64 ÷ memory | 0.7 | 0.8 (0.75) |" in text
    assert "| owen f32 ÷ sobol_burley | 5 | – |" in text  # not measured
    assert "| memory f64 | 2000 (2400) | – |" in text
    assert "| owen f64 | d = 8, n = 2^20 | 15 (20) | 25 (35) | 1.75 |" in text
    assert "| halton (owen) | d = 64, n = 2^20 | 80 (80) | SciPy: 4, QMCPy: 9 | 8.89 (8) |" in text
    assert "CPU seconds for d = 100, n = 2^20" in text
    assert "| lattice | 2.0 |" in text
