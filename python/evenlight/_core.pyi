"""The compiled door to the Rust core: private. The public interface is `evenlight`."""

from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__version__: str

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
def check_writable(path: str) -> None: ...
def write_exr(
    path: str, layers: list[tuple[str, list[str], NDArray[np.float32]]], metadata: dict[str, str]
) -> None: ...
def write_png(path: str, image: NDArray[np.float32], exposure: float, metadata: dict[str, str]) -> None: ...
