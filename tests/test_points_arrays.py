"""Arrays that points go to: NumPy's, those of other libraries, and those that are refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from evenlight.points import Sobol


def test_wrong_arrays_are_refused() -> None:
    sobol = Sobol(2)
    with pytest.raises(ValueError, match=r"out must have shape \(8, 2\), not \(8, 3\)"):
        sobol.points(0, 8, np.empty((8, 3)))
    with pytest.raises(ValueError, match=r"out must have shape \(8, 2\), not \(16,\)"):
        sobol.points(0, 8, np.empty(16))
    with pytest.raises(ValueError, match="out must be C-contiguous"):
        sobol.points(0, 8, np.empty((2, 8)).T)
    with pytest.raises(TypeError, match="writable array of float64 or float32, not int64"):
        sobol.points(0, 8, np.empty((8, 2), dtype=np.int64))
    with pytest.raises(TypeError, match="out must be a numpy array or export DLPack, not list"):
        sobol.points(0, 8, [[0.0, 0.0]] * 8)
    constant = np.empty((8, 2))
    constant.flags.writeable = False
    with pytest.raises(TypeError, match="out must be a writable array"):
        sobol.points(0, 8, constant)


class Foreign:
    """An array of another library: all that is known of it is that it exports DLPack."""

    def __init__(self, array: npt.NDArray[np.float64]) -> None:
        self.array = array

    def __dlpack__(self, **arguments: Any) -> Any:
        return self.array.__dlpack__(**arguments)

    def __dlpack_device__(self) -> Any:
        return self.array.__dlpack_device__()

    @classmethod
    def from_dlpack(cls, array: npt.NDArray[np.float64]) -> Foreign:
        """Take over an array, as the array API standard has it."""
        return cls(np.asarray(np.from_dlpack(array), dtype=np.float64))


def test_points_go_into_arrays_of_other_libraries() -> None:
    sobol = Sobol(3, seed=1)
    out = Foreign(np.zeros((8, 3)))
    assert sobol.points(0, 8, out) is out
    np.testing.assert_array_equal(out.array, sobol.points(0, 8))
    made = sobol.points(0, 8, xp=Foreign)
    assert isinstance(made, Foreign)
    np.testing.assert_array_equal(made.array, out.array)
    assert isinstance(sobol.points(0, 8, xp=np), np.ndarray)
    with pytest.raises(TypeError, match="give one of them"):
        sobol.points(0, 8, out, xp=np)


class OutOfReach(Foreign):
    """An array that is not in main memory."""

    def __dlpack__(self, **arguments: Any) -> Any:
        raise BufferError("it is on another device")


def test_arrays_out_of_reach_are_refused() -> None:
    with pytest.raises(TypeError, match="NumPy can view; OutOfReach cannot be: it is on another device"):
        Sobol(3).points(0, 8, OutOfReach(np.zeros((8, 3))))
