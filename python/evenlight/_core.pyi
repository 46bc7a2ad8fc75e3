"""The compiled core: private. The public faces are the modules beside it."""

from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "PointSet",
    "Scene",
    "__version__",
    "available_sequences",
    "check_writable",
    "filters",
    "integrators",
    "load_scene",
    "render",
    "replicate_seed",
    "samplers",
    "write_exr",
    "write_png",
]

__version__: str

# --- points ---

@final
class PointSet:
    def __new__(cls, name: str, dims: int, scramble: str, seed: int) -> PointSet: ...
    @property
    def dims(self) -> int: ...
    def coord(self, index: int, dim: int) -> float: ...
    def fill(self, start: int, stop: int, out: NDArray[np.float64] | NDArray[np.float32]) -> None: ...

def replicate_seed(seed: int, replicate: int) -> int: ...
def available_sequences() -> list[tuple[str, str, list[str], int]]: ...

# --- render ---

@final
class Scene:
    @property
    def warnings(self) -> list[str]: ...
    def info(self) -> dict[str, Any]: ...

def load_scene(
    path: str,
    parameters: dict[str, str],
    lenient: bool,
    allow_outside: bool,
    embree_library: str | None,
    kernel: str,
) -> Scene: ...
def render(
    scene: Scene, settings: dict[str, Any], progress: Callable[[dict[str, Any]], None] | None
) -> dict[str, Any]: ...
def integrators() -> list[str]: ...
def samplers() -> list[str]: ...
def filters() -> list[str]: ...

# --- output ---

def check_writable(path: str) -> None: ...
def write_exr(
    path: str, layers: list[tuple[str, list[str], NDArray[np.float32]]], metadata: dict[str, str]
) -> None: ...
def write_png(path: str, image: NDArray[np.float32], exposure: float, metadata: dict[str, str]) -> None: ...
