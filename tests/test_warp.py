"""The faces of the warps: arrays of any shape and precision, refusals, and the registry."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from evenlight import _core, points, warp

# As in crates/points/tests/warp_domains/mod.rs, for those that do not do without.
OPTIONS: dict[str, dict[str, Any]] = {
    "hilbert": {"dims": 3},
    "morton": {"dims": 2},
    "gray": {"dims": 5},
    "simplex": {"dims": 4},
    "cap": {"angle": 0.8},
    "spherical_triangle": {"corners": [[1.0, 0.2, 0.3], [-0.5, 1.5, 0.4], [0.1, -0.3, 1.0]]},
    "spherical_rectangle": {"corners": [[-0.5, 0.25, 0.75], [1.5, 0.25, 0.75], [-0.5, 1.75, 0.75]]},
    "piecewise_linear": {"values": [0.5, 2.0, 1.0, 0.0, 3.0]},
    "piecewise_constant": {"values": [1.0, 0.0, 5.0, 2.0], "knots": [0.0, 0.1, 0.5, 2.0, 3.0]},
    "discrete": {"values": [3.0, 0.0, 1.0]},
    "discrete_alias": {"values": [3.0, 0.0, 1.0]},
    "image": {"values": [[0.0, 1.0, 2.0], [3.0, 0.5, 0.0]]},
}


@pytest.fixture(params=[info.name for info in warp.available()])
def member(request: pytest.FixtureRequest) -> warp.Warp:
    """Every registered warp."""
    return warp.build(request.param, **OPTIONS.get(request.param, {}))


def folds(member: warp.Warp) -> bool:
    return next(info.folds for info in warp.available() if info.name == member.warp)


def test_every_warp_has_a_class() -> None:
    assert list(warp.WARPS) == _core.warps()
    for kind in warp.WARPS.values():
        assert kind.__name__ in warp.__all__
        assert ">>>" in (kind.__doc__ or ""), kind


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
def test_arrays_of_any_shape_keep_their_precision(member: warp.Warp, dtype: type) -> None:
    u = points.Sobol(member.inputs, seed=3).points(0, 24).astype(dtype).reshape(2, 3, 4, member.inputs)
    x = member.map(u)
    assert x.shape == (2, 3, 4, member.outputs)
    assert member.density(x).shape == (2, 3, 4)
    assert member.invert(x).shape == u.shape
    assert {x.dtype, member.density(x).dtype, member.invert(x).dtype} == {np.dtype(dtype)}
    assert (member.density(x) > 0).all()
    np.testing.assert_array_equal(member.map(u[1, 2, 3]), x[1, 2, 3])
    assert member.map(u[:0]).shape == (0, 3, 4, member.outputs)


def test_warps_can_be_undone(member: warp.Warp) -> None:
    u = points.Independent(member.inputs, seed=1).points(0, 5000)
    x = member.map(u)
    back = member.invert(x)
    difference = member.map(back) - x if folds(member) else back - u
    assert abs(difference).max() <= 1e-12


def test_threads_do_not_change_a_bit(member: warp.Warp) -> None:
    u = points.Independent(member.inputs, seed=2).points(0, 40_000)
    np.testing.assert_array_equal(member.map(u, workers=3), member.map(u))


def test_warps_travel(member: warp.Warp) -> None:
    copy = pickle.loads(pickle.dumps(member))
    assert repr(copy) == repr(member)
    u = points.Independent(member.inputs).points(0, 10)
    np.testing.assert_array_equal(copy.map(u), member.map(u))


def test_mistakes_are_named() -> None:
    with pytest.raises(ValueError, match="unknown warp 'nowhere'; known: triangle_root, "):
        warp.build("nowhere")
    with pytest.raises(TypeError, match="TriangleHeitz has no option 'angle'; it has: none"):
        warp.TriangleHeitz(angle=1)
    with pytest.raises(TypeError, match="Gaussian has no option"):
        warp.Gaussian(sigma=1)
    heitz = warp.TriangleHeitz()
    with pytest.raises(ValueError, match=r"u must have 2 numbers in its last axis, not shape \(5, 3\)"):
        heitz.map(np.zeros((5, 3)))
    with pytest.raises(ValueError, match=r"u must be in \[0, 1\), not from 0.0 to 1.0"):
        heitz.map([0.0, 1.0])
    with pytest.raises(ValueError, match="u must be in"):
        heitz.map([0.5, np.nan])
    with pytest.raises(ValueError, match="x must have 3 numbers"):
        heitz.density([0.5, 0.5])
    with pytest.raises(ValueError, match="workers must be at least 1"):
        heitz.map([0.5, 0.5], workers=0)
