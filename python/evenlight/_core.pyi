"""The compiled core: private. The public faces are the modules beside it."""

from collections.abc import Callable, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "PointSet",
    "Scene",
    "Warp",
    "__version__",
    "available_blue_noise",
    "available_sequences",
    "available_warps",
    "blue_noise_points",
    "bsdfs",
    "check_writable",
    "cloud_order",
    "construct_korobov",
    "construct_lattice",
    "construct_polynomial_lattice",
    "curve_cells",
    "curve_index",
    "curve_order",
    "curve_points",
    "digital_net_error",
    "dispersion",
    "dither_planes",
    "drawn_places",
    "emitters",
    "extreme_discrepancy",
    "filters",
    "gain_coefficient",
    "heuristics",
    "integrators",
    "isotropic_discrepancy",
    "kernels",
    "l2_discrepancy",
    "lattice_error",
    "load_scene",
    "local_discrepancy",
    "measure_bounces",
    "pixel_places",
    "relaxed",
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
    "triangle_kronecker",
    "triangle_product",
    "triangle_van_der_corput",
    "warps",
    "write_exr",
    "write_png",
]

__version__: str

_Numbers = NDArray[np.float64] | NDArray[np.float32]

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

# --- lattices ---

def construct_lattice(
    n: int, least: int | None, weights: Sequence[float], space_name: str, smoothness: int
) -> list[int]: ...
def construct_polynomial_lattice(n: int, least: int | None, weights: Sequence[float]) -> list[int]: ...
def construct_korobov(n: int, weights: Sequence[float], space_name: str, smoothness: int, candidates: int) -> int: ...
def lattice_error(
    generator: Sequence[int], n: int, weights: Sequence[float], space_name: str, smoothness: int
) -> float: ...
def digital_net_error(x: NDArray[np.float64], weights: Sequence[float]) -> float: ...

# --- warp ---

@final
class Warp:
    def __new__(
        cls,
        name: str,
        *,
        dims: int | None = None,
        angle: float | None = None,
        radius: float | None = None,
        tube: float | None = None,
        height: float | None = None,
        corners: Sequence[Sequence[float]] | None = None,
        values: Sequence[float] | None = None,
        knots: Sequence[float] | None = None,
        columns: int | None = None,
    ) -> Warp: ...
    @property
    def inputs(self) -> int: ...
    @property
    def outputs(self) -> int: ...
    def map(self, u: _Numbers, out: _Numbers, workers: int) -> None: ...
    def density(self, x: _Numbers, out: _Numbers, workers: int) -> None: ...
    def invert(self, x: _Numbers, out: _Numbers, workers: int) -> None: ...

def available_warps() -> list[tuple[str, str, list[str], bool]]: ...
def triangle_van_der_corput(
    start: int, corners: Sequence[float], scramble: str, seed: int, out: NDArray[np.float64]
) -> None: ...
def triangle_kronecker(n: int, angle: float, shift: tuple[float, float]) -> NDArray[np.float64]: ...
def triangle_product(
    start: int, corners: NDArray[np.float64], scramble: str, seed: int, out: NDArray[np.float64]
) -> None: ...
def curve_cells(curve: str, index: NDArray[np.uint64], dims: int, bits: int) -> NDArray[np.uint32]: ...
def curve_index(curve: str, cells: NDArray[np.uint32], bits: int) -> NDArray[np.uint64]: ...
def curve_points(curve: str, source: str, n_start: tuple[int, int], seed: int, out: NDArray[np.float64]) -> None: ...
def curve_order(
    curve: str, x: NDArray[np.float64], lower: Sequence[float], upper: Sequence[float], workers: int
) -> NDArray[np.uint32]: ...

# --- particles ---

def cloud_order(x: NDArray[np.float64]) -> NDArray[np.int64]: ...
def drawn_places(weights: NDArray[np.float64], numbers: NDArray[np.float64]) -> NDArray[np.int64]: ...

# --- blue noise ---

def available_blue_noise() -> list[tuple[str, str, bool, str, int]]: ...
def blue_noise_points(
    name: str, shape: tuple[int, int], effort: int, seed: int, workers: int
) -> NDArray[np.float64]: ...
def dither_planes(shape: tuple[int, int, int], tries: int, seed: int, workers: int) -> NDArray[np.float64]: ...
def pixel_places(curve: str, shape: tuple[int, int], shuffle: int | None) -> NDArray[np.uint64]: ...
def relaxed(x: NDArray[np.float64], steps: int, workers: int) -> NDArray[np.float64]: ...

# --- quality ---

def local_discrepancy(x: NDArray[np.float64], corners: NDArray[np.float64], closed: bool) -> NDArray[np.float64]: ...
def dispersion(x: NDArray[np.float64], torus: bool, limit: int) -> tuple[float, list[float], list[float]]: ...
def extreme_discrepancy(x: NDArray[np.float64]) -> tuple[float, list[float], list[float], bool]: ...
def gain_coefficient(x: NDArray[np.float64], levels: Sequence[int | None], base: int) -> float: ...
def isotropic_discrepancy(
    x: NDArray[np.float64], sectors: int, workers: int
) -> tuple[float, list[list[float]], bool, float]: ...
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
def measure_bounces(scene: Scene, settings: dict[str, Any], images: bool) -> dict[str, Any]: ...

# --- families: the names in each registry ---

def scrambles() -> list[str]: ...
def warps() -> list[str]: ...
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
