"""The compiled core; the public faces are the packages beside it."""

from typing import final

import numpy as np
import numpy.typing as npt

__all__ = ["PointSet", "__version__", "available_sequences", "replicate_seed"]
__version__: str

# --- points ---

@final
class PointSet:
    def __new__(cls, name: str, dims: int, scramble: str, seed: int) -> PointSet: ...
    @property
    def dims(self) -> int: ...
    def coord(self, index: int, dim: int) -> float: ...
    def fill(self, start: int, stop: int, out: npt.NDArray[np.float64] | npt.NDArray[np.float32]) -> None: ...

def replicate_seed(seed: int, replicate: int) -> int: ...
def available_sequences() -> list[tuple[str, str, list[str], int]]: ...

# --- end of points ---
