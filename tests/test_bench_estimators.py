"""The tables of `make bench-estimators`, from numbers whose shares are known."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benches.estimators import measure, to_markdown


def test_the_report_is_a_pure_function_of_the_record() -> None:
    good = {"runs": 4, "rmse": 1e-3, "errors": [0.1, 0.2, 0.3, 0.4], "covered": 1.0, "values": 2048.0, "seconds": 0.004}
    bad = good | {"errors": [0.1, 0.2, 0.6, 0.7], "seconds": 0.04}
    record = {
        "machine": {"date": "today"},
        "tolerances": [{"integrand": "ball", "d": 3, "atol": 0.5, "rules": {"ours": good, "theirs": bad}}],
        "singular": {"adaptive mixture": good, "pypmc": bad},
        "weights": [{"rows": 10_000, "components": 1000, "seconds": 0.5, "gap": 1e-7}],
    }
    text = to_markdown(record)
    assert text == to_markdown(record)
    assert "| ball, d = 3, 0.5 | 2,048; 100%; 4 | 2,048; **50%**; 40 |" in text
    assert "| pypmc | 1.0e-03 | 100% | 0.04 | 10 | 4 |" in text
    assert "| 10,000 | 1,000 | 0.50 | 1.0e-07 |" in text


def test_runs_are_measured_by_their_errors() -> None:
    """Errors 0, 0.1, 0.2, 0.3 of 2, with intervals of 0.15."""
    found = measure(lambda seed: (2 + 0.1 * seed, 0.15, 100 * (seed + 1)), 2.0, 4)
    assert (found["covered"], found["values"], found["runs"]) == (0.5, 250, 4)
    assert abs(found["rmse"] - 0.5 * (0.14 / 4) ** 0.5) < 1e-12
    assert all(abs(error - 0.1 * rank) < 1e-12 for rank, error in enumerate(found["errors"]))
