"""The golden bits of the Rust tests, from outside."""

from __future__ import annotations

from typing import Any

import numpy as np

from conftest import ROOT, fitting_dims, sobol_matrices
from evenlight import points

# As in crates/points/tests/examples/mod.rs.
GOLDEN: dict[str, dict[str, Any]] = {
    "hammersley": {"n": 1 << 14},
    "latin_hypercube": {"n": 1200},
    "multi_jittered": {"n": 1200},
    "correlated_multi_jittered": {"n": 1200},
    "orthogonal_array": {"n": 41**2},
    "stratified": {"n": 1},
    "mersenne_twister": {"n": 5000},
    "fibonacci": {"n": 1597},
    "korobov": {"n": 1021},
    "digital_net": sobol_matrices(40),
}


def test_golden_bits_reach_python() -> None:
    golden = ROOT / "crates" / "points" / "tests" / "golden.txt"
    for line in golden.read_text().splitlines():
        name, scramble, index, *bits = line.split()
        row, d = int(index), fitting_dims(name, 40)
        sequence = points.build(name, d, scramble=scramble, seed=7, **GOLDEN.get(name, {}))
        if row == 2**64 - 1:  # no half-open range contains the last row
            continue
        values = sequence.points(row, row + 1)[0, [dim for dim in (0, 1, 5, 39) if dim < d]]
        assert [f"{word:016x}" for word in values.view(np.uint64)] == bits, line
