"""The compiled core: private. The public faces are the modules beside it."""

from collections.abc import Callable, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "PointSet",
    "Scene",
    "__version__",
    "available_sequences",
    "bsdfs",
    "check_writable",
    "dispersion",
    "emitters",
    "extreme_discrepancy",
    "filters",
    "gain_coefficient",
    "heuristics",
    "integrators",
    "kernels",
    "l2_discrepancy",
    "load_scene",
    "local_discrepancy",
    "render",
    "replicate_seed",
    "samplers",
    "scrambles",
    "sensors",
    "shapes",
    "smallest_t",
    "star_discrepancy",
    "star_discrepancy_cost",
    "t_value",
    "t_value_in_base",
    "textures",
    "triangle_discrepancy",
    "write_exr",
    "write_png",
]

__version__: str

# --- points ---

@final
class PointSet:
    def __new__(
        cls,
        name: str,
        dims: int,
        scramble: str,
        seed: int,
        *,
        n: int | None = None,
        base: int | None = None,
        order: int | None = None,
        strength: int | None = None,
        generator: Sequence[int] | None = None,
        matrices: Sequence[Sequence[int]] | None = None,
        bits: int | None = None,
    ) -> PointSet: ...
    @property
    def dims(self) -> int: ...
    @property
    def count(self) -> int | None: ...
    @property
    def base(self) -> int | None: ...
    def generating_matrices(self) -> list[list[int]] | None: ...
    def coord(self, index: int, dim: int) -> float: ...
    def fill(self, start: int, stop: int, out: NDArray[np.float64] | NDArray[np.float32], workers: int) -> None: ...
    def fill_replicates(
        self,
        seed: int,
        rows: tuple[int, int],
        replicates: int,
        out: NDArray[np.float64] | NDArray[np.float32],
        workers: int,
    ) -> None: ...

def replicate_seed(seed: int, replicate: int) -> int: ...
def available_sequences() -> list[tuple[str, str, list[str], list[str], int]]: ...

# --- quality ---

def local_discrepancy(x: NDArray[np.float64], corners: NDArray[np.float64], closed: bool) -> NDArray[np.float64]: ...
def dispersion(x: NDArray[np.float64], limit: int) -> tuple[float, list[float], list[float]]: ...
def extreme_discrepancy(x: NDArray[np.float64]) -> tuple[float, list[float], list[float], bool]: ...
def gain_coefficient(x: NDArray[np.float64], levels: Sequence[int | None], base: int) -> float: ...
def l2_discrepancy(
    x: NDArray[np.float64], measure: str, weights: Sequence[float] | None, algorithm: str, workers: int
) -> float: ...
def smallest_t(x: NDArray[np.float64], base: int) -> int: ...
def star_discrepancy(
    x: NDArray[np.float64], settings: dict[str, Any], progress: Callable[[float], object] | None
) -> tuple[float, str, list[float], float, bool, str]: ...
def star_discrepancy_cost(x: NDArray[np.float64], seed: int) -> float: ...
def t_value(matrices: Sequence[Sequence[int]], m: int) -> int: ...
def t_value_in_base(base: int, matrices: Sequence[Sequence[Sequence[int]]], m: int) -> int: ...
def triangle_discrepancy(barycentric: NDArray[np.float64], sets: str) -> tuple[float, list[float], bool, list[int]]: ...

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

# --- families: the names in each registry ---

def scrambles() -> list[str]: ...
def integrators() -> list[str]: ...
def samplers() -> list[str]: ...
def filters() -> list[str]: ...
def bsdfs() -> list[str]: ...
def emitters() -> list[str]: ...
def shapes() -> list[str]: ...
def textures() -> list[str]: ...
def sensors() -> list[str]: ...
def kernels() -> list[str]: ...
def heuristics() -> list[str]: ...

# --- output ---

def check_writable(path: str) -> None: ...
def write_exr(
    path: str, layers: list[tuple[str, list[str], NDArray[np.float32]]], metadata: dict[str, str]
) -> None: ...
def write_png(path: str, image: NDArray[np.float32], exposure: float, metadata: dict[str, str]) -> None: ...
