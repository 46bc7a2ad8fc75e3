"""Every sequence under SciPy's own tests of its engines, taken from the installed SciPy."""

from __future__ import annotations

from typing import Any

import pytest
from scipy.stats.tests import test_qmc  # type: ignore[import-not-found]  # its tests have no stubs

from conftest import sobol_matrices
from evenlight import points

INDEPENDENT = {"test_distribution": "its tolerance is for evenly spread points"}
PART = {"test_distribution": "has no 1024 points in 50 dimensions"}
LLOYD = {"test_optimizers": "Lloyd's iterations bring its points nearer to each other"}

SKIPPED: dict[str, dict[str, str]] = {
    "independent": INDEPENDENT,
    "philox": INDEPENDENT,
    "pcg": INDEPENDENT,
    "mersenne_twister": INDEPENDENT,
    "interlaced_sobol": {"test_distribution": "quartiles of single coordinates are not what it is even in"},
    "orthogonal_array": PART,
    "stratified": PART | {"test_bounds": "has no 512 points in 100 dimensions"},
    "correlated_multi_jittered": LLOYD,
    "hammersley": LLOYD,
    "lattice": LLOYD,
    "korobov": LLOYD,
    "fibonacci": LLOYD,
    "kronecker": LLOYD | {"test_distribution": "its tolerance is for points that are even in 50 dimensions"},
}
"""Tests that cannot hold for a sequence, with the reason."""

COUNTS: dict[str, int] = {"orthogonal_array": 131**2, "stratified": 64**2, "fibonacci": 4181}
"""The number of points, for those that cannot have any: the tests draw the first of them."""


class Contract(test_qmc.QMCEngineTests):  # type: ignore[misc]  # no stubs
    """SciPy's tests, with the arguments that our engines take."""

    __test__ = False
    can_scramble = True

    def engine(self, scramble: bool, rng: Any = 170382760648021597650530316304495310428, **arguments: Any) -> Any:
        """Build what a test asks for."""
        info = next(info for info in points.available() if info.name == self.qmce.sequence)
        if arguments["d"] > info.most_dims:
            pytest.skip(f"has {info.most_dims} dimensions")
        if info.name in COUNTS:
            arguments.setdefault("n", COUNTS[info.name])
        if info.name == "digital_net":
            arguments |= sobol_matrices(arguments["d"])
        if len(info.scrambles) == 1:
            return self.qmce(seed=rng, **arguments)
        if not scramble and "none" not in info.scrambles:
            pytest.skip("is always random")
        return self.qmce(scramble=scramble, seed=rng, **arguments)

    def test_sample(self, *_: Any) -> None:
        """Skip the test that has the numbers of SciPy's sequences."""
        pytest.skip("compares with the numbers of one implementation")


def contract(name: str, sequence: type[points.Engine]) -> type[Contract]:
    """The tests of one sequence."""
    members: dict[str, Any] = {"__test__": True, "qmce": sequence}
    for test, reason in SKIPPED.get(name, {}).items():
        members[test] = lambda self, *_, reason=reason: pytest.skip(reason)
    if sequence.finite:
        for test in ("test_continuing", "test_fast_forward"):
            members[test] = lambda self, *_: pytest.skip("is no sequence: its number of points is known beforehand")
    tests = type(f"Test{sequence.__name__}", (Contract,), members)
    return pytest.mark.filterwarnings("ignore:.*are balanced in powers of.*:UserWarning")(tests)


globals().update({f"Test{sequence.__name__}": contract(name, sequence) for name, sequence in points.SEQUENCES.items()})
