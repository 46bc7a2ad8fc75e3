"""Points made by several threads are the same points."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from conftest import fitting_count, fitting_dims
from evenlight import points


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("info", points.available(), ids=lambda info: info.name)
def test_the_number_of_workers_changes_nothing(
    info: points.SequenceInfo, dtype: type[np.float64] | type[np.float32]
) -> None:
    d = fitting_dims(info.name, 5)
    engine = points.build(info.name, d, seed=11, **fitting_count(info.name, d, 40_008))
    alone: Any = np.empty((40_001, d), dtype)
    together: Any = np.empty((40_001, d), dtype)
    engine.points(7, 40_008, alone)
    for workers in (2, 3, -1):
        engine.points(7, 40_008, together, workers=workers)
        np.testing.assert_array_equal(alone, together)


@pytest.mark.parametrize("workers", [0, -2])
def test_workers_that_make_no_sense_are_refused(workers: int) -> None:
    with pytest.raises(ValueError, match="workers must be at least"):
        points.Sobol(2).points(0, 1, workers=workers)
