"""The golden bits of the Rust tests, from outside."""

from __future__ import annotations

from typing import Any

import numpy as np

from conftest import ROOT, sobol_matrices
from evenlight import points

# As in crates/points/tests/examples/mod.rs.
GOLDEN: dict[str, dict[str, Any]] = {
    "latin_hypercube": {"n": 1200},
    "multi_jittered": {"n": 1200},
    "correlated_multi_jittered": {"n": 1200},
    "orthogonal_array": {"n": 41**2},
    "stratified": {"n": 1},
    "mersenne_twister": {"n": 5000},
    "digital_net": sobol_matrices(40),
}

MOST_DIMS = {info.name: info.most_dims for info in points.available()}


def test_golden_bits_reach_python() -> None:
    golden = ROOT / "crates" / "points" / "tests" / "golden.txt"
    for line in golden.read_text().splitlines():
        name, scramble, index, *bits = line.split()
        row = int(index)
        dims = min(40, MOST_DIMS[name])
        sequence = points.build(name, dims, scramble=scramble, seed=7, **GOLDEN.get(name, {}))
        if row == 2**64 - 1:  # no half-open range contains the last row
            continue
        values = sequence.points(row, row + 1)[0, [dim for dim in (0, 1, 5, 39) if dim < dims]]
        assert [f"{word:016x}" for word in values.view(np.uint64)] == bits, line
