"""The compiled core; the public faces are the packages beside it."""

import numpy as np
import numpy.typing as npt

__version__: str

# --- points ---

class PointSet:
    def __new__(cls, name: str, dims: int, scramble: str, seed: int) -> PointSet: ...
    @property
    def dims(self) -> int: ...
    def coord(self, index: int, dim: int) -> float: ...
    def fill(
        self, start: int, stop: int, out: npt.NDArray[np.float64] | npt.NDArray[np.float32]
    ) -> None: ...

def available_sequences() -> list[tuple[str, str, list[str], int]]: ...

# --- end of points ---
