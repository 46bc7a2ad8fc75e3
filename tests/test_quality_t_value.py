"""Quality parameters of nets and their generating matrices, from outside."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from evenlight import points
from evenlight.points import DigitalNet, Halton, InterlacedSobol, NiederreiterXing, Sobol
from evenlight.quality import t_value


def test_nets_have_the_known_values() -> None:
    assert [t_value(Sobol(3), m) for m in range(1, 13)] == [0] + 11 * [1]
    assert [t_value(Sobol(5), m) for m in range(1, 13)] == [0, 1, 2, 2, 2, 3, 3, 3, 3, 3, 4, 4]
    assert [t_value(NiederreiterXing(d), 16) for d in range(1, 10)] == [0, 0, 1, 1, 2, 3, 4, 5, 6]
    assert t_value(points.Sz(6), 20, dims=[4, 5]) == t_value(points.Dyadic(6), 20, dims=(2, 3)) == 0
    assert t_value(points.Sz(6), 20, dims=[1, 5]) > 0


def test_faure_is_perfect_in_base_five() -> None:
    pascal = np.array([[1, 1, 1], [0, 1, 2], [0, 0, 1]])
    faure = np.array([np.linalg.matrix_power(pascal, a) % 5 for a in range(5)])
    assert t_value(faure, 3, base=5) == 0
    assert t_value(faure[[1, 1]], 3, base=5) == 2


@pytest.mark.parametrize("scramble", ["none", "digital_shift", "linear"])
def test_points_are_made_by_their_matrices(scramble: str) -> None:
    for engine in (Sobol(4), NiederreiterXing(5), InterlacedSobol(3, order=3), points.Sz(3)):
        columns = engine.generating_matrices()
        assert columns.dtype == np.uint64
        row = np.bitwise_xor.reduce(columns[:, [0, 3, 4, 9]], axis=1)  # 1 + 8 + 16 + 512
        plain = points.build(engine.sequence, engine.d, scramble="none", **engine._options)
        np.testing.assert_array_equal((row >> np.uint64(11)) * 2.0**-53, plain.points(537, 538)[0])
        net = DigitalNet(matrices=columns, bits=64, scramble=scramble, seed=3)
        if engine.sequence != "interlaced_sobol":  # which is scrambled before it is interlaced
            own = points.build(engine.sequence, engine.d, scramble=scramble, seed=3)
            np.testing.assert_array_equal(net.points(5, 99), own.points(5, 99))
            assert net.n == engine.n


def test_a_net_of_fewer_dimensions_has_the_first_matrices() -> None:
    columns = Sobol(3).generating_matrices()[:, :10]
    few = DigitalNet(2, matrices=columns, bits=64)
    assert few.n == 1024
    assert repr(few).startswith("DigitalNet(2, scramble='owen', matrices=[[9223372036854775808, ")
    np.testing.assert_array_equal(few.random(8), DigitalNet(matrices=columns, bits=64).random(8)[:, :2])


@pytest.mark.parametrize(
    ("net", "m", "options", "error", "message"),
    [
        (Halton(2), 3, {}, ValueError, "has no generating matrices in base 2"),
        (Sobol(2, scramble="shift"), 3, {}, ValueError, "a shift modulo 1 does not keep nets"),
        (Sobol(2), 65, {}, ValueError, "m must be 0 to 64, the size of the matrices, not 65"),
        (Sobol(2), -1, {}, ValueError, "m must be 0 to 64"),
        (Sobol(2), 3, {"dims": [2]}, ValueError, "dimension 2 of a net of 2 dimensions"),
        (Sobol(2), 3, {"dims": []}, ValueError, "at least one dimension"),
        ([[0.5, 0.25]], 1, {}, TypeError, "array of integers, not of float64"),
        ([1, 2], 1, {}, ValueError, r"must have shape \(d, m\) in base 2"),
        ([[1, 2]], 1, {"base": 3}, ValueError, r"not \(1, 2\) in base 3"),
        ([[[1]]], 1, {"base": 4}, ValueError, "prime below 2\\^16, not 4"),
        ([[-1]], 1, {}, ValueError, "no negative numbers"),
    ],
)
def test_what_is_no_net_is_refused(
    net: Any, m: int, options: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        t_value(net, m, **options)


def test_matrices_that_are_none_are_refused() -> None:
    with pytest.raises(TypeError, match="a list of columns for each dimension"):
        DigitalNet(matrices=3, bits=4)
    with pytest.raises(ValueError, match="must be numbers below 2\\^2, as 'bits' says, not 4"):
        DigitalNet(matrices=[[1, 4]], bits=2)
    with pytest.raises(ValueError, match="one list of columns for each of 3 dimensions, not 1"):
        DigitalNet(3, matrices=[[1, 2]], bits=2)


def test_direction_numbers_of_others_are_read(tmp_path: Path) -> None:
    # The first lines of new-joe-kuo-6 as published, and one of tkrg-a-ap5.
    path = tmp_path / "numbers"
    path.write_text(
        "d       s       a       m_i\n2 1 0 1\n3 2 1 1 3\n4 3 1 1 3 1\n5 3 2 1 1 1\n6 4 1 1 1 3 3\n7 4 4 1 3 7 1\n"
    )
    columns = points.read_direction_numbers(path)
    np.testing.assert_array_equal(columns[:6], Sobol(6).generating_matrices())
    assert columns.shape == (7, 64)
    np.testing.assert_array_equal(columns[6, :4] >> np.uint64(60), [8, 12, 14, 1])
    np.testing.assert_array_equal(points.read_direction_numbers(path, 3), columns[:3])
    with pytest.raises(ValueError, match="has 7 dimensions, not 8"):
        points.read_direction_numbers(path, 8)
    for line in ("2 1 0 2", "2 2 1 1", "3 1 0 1", "2 2 2 1 3"):
        path.write_text(line)
        with pytest.raises(ValueError, match=r"dimension 2: the line must be d s a m_1 \.\.\. m_s"):
            points.read_direction_numbers(path)


def test_nets_of_others_are_read(tmp_path: Path) -> None:
    path = tmp_path / "net"
    path.write_text("# dnetup\n2 # base\n2 # dimensions\n4 # points\n3 # digits\n4 2\n4 6\n")
    matrices, bits = points.read_matrices(path)
    assert (matrices.tolist(), bits) == ([[4, 2], [4, 6]], 3)
    assert t_value(matrices << np.uint64(61), 2) == 0
    path.write_text("3\n1\n4\n3\n4 2\n")
    with pytest.raises(ValueError, match="base 3, not 2"):
        points.read_matrices(path)
    path.write_text("2\n2\n4\n3\n4 2\n")
    with pytest.raises(ValueError, match=r"must have base, d, 2\^m and digits, then d lines of m columns"):
        points.read_matrices(path)


def test_interlaced_matrices_are_those_of_the_magic_point_shop() -> None:
    """The first and last columns of its sobol_alpha3_Bs53 (D. Nuyens), 53 digits of each."""
    columns = InterlacedSobol(3, order=3).generating_matrices() >> np.uint64(11)
    assert columns[0, :3].tolist() == [7881299347898368, 4362862139015168, 2515682604351488]
    assert columns[1, :3].tolist() == [7881299347898368, 5488762045857792, 263882790666240]
    assert columns[:, 31].tolist() == [3840157793161801, 3003865835434477, 8444362064792170]
