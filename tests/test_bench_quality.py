"""The tables of `make bench-quality`, from numbers whose ratios are known."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benches.quality import METHODS, measure_star, to_markdown


def test_the_report_is_a_pure_function_of_the_record() -> None:
    times = {"evenlight": [2.0, 1.0, 4.0], "SciPy": [30.0, 10.0, 20.0], "difference": 1e-12}
    star = {"points": "sobol", "d": 3, "n": 8, "value": 0.25, "method": "dem", "seconds": 0.5, "steps": 1e6}
    bounds = {"threshold_accepting": {"value": 0.2, "seconds": 1}, "bracketing": {"value": 0.3, "seconds": 2}}
    record = {
        "machine": {"date": "today"},
        "rounds": 3,
        "l2": [{"d": 5, "n": 4096, "times": dict.fromkeys(METHODS, times)}],
        "stars": [star | bounds, {**star, "d": 1, "method": "sweep"}],
        "indices": {"evaluations": 80, "apart": 1.234, "error": 0.001, "SALib_error": 0.02},
        "sorts": [
            {"d": 2, "n": 4096, "evenlight": 2e-4, "argsort": 1e-4, "particles": 5e-3},
            {"d": 3, "n": 10, "evenlight": 1e-6, "argsort": 1e-6, "particles": None},
        ],
    }
    text = to_markdown(record)
    assert text == to_markdown(record)
    assert "| d = 5, n = 4096 | 10 (10) | 10 (10) | 10 (10) | 10 (10) |" in text
    assert "| sobol | 3 | 8 | 0.250000 | dem | 0.5 | 1.0e+06 | 0.200000 (1) | 0.300000 (2) |" in text
    assert "| sobol | 1 | 8 | 0.250000 | sweep |" in text
    assert "1e-12" in text
    assert "at most 1.2 combined standard errors apart" in text
    assert "| 2 | 4096 | 200 | 100 | 5e+03 | 25 |" in text
    assert "| 3 | 10 | 1 | 1 | – | – |" in text


def test_a_measured_star_discrepancy_has_its_bounds() -> None:
    case = measure_star("sobol", 3, 64)
    assert case["threshold_accepting"]["value"] <= case["value"] <= case["bracketing"]["value"]
    assert case["kind"] == "exact"
