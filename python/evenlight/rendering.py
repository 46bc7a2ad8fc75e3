"""Scenes to films."""

from __future__ import annotations

import importlib.util
import operator
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, SupportsIndex, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenlight import _core
from evenlight.film import Film

__all__ = ["Film", "Scene", "load_scene", "render"]

Progress: TypeAlias = Callable[[dict[str, Any]], None]
Roulette: TypeAlias = str | Sequence[float] | NDArray[np.floating]


@dataclass(frozen=True)
class Scene:
    """A scene that was read and is ready to be rendered, any number of times.

    Attributes
    ----------
    path : Path
        The file it came from.
    parameters : dict
        The scene file's parameters that were overridden.
    kernel : str
        The ray kernel that was asked for.
    warnings : tuple of str
        What a lenient reader substituted: each with file, line and the substitute.

    Examples
    --------
    >>> import evenlight
    >>> evenlight.load_scene("scenes/sky.xml", reflectance=0.25).parameters
    {'reflectance': '0.25'}
    """

    path: Path
    parameters: dict[str, str]
    kernel: str
    warnings: tuple[str, ...]
    _core: _core.Scene = field(repr=False, compare=False)

    def info(self) -> dict[str, Any]:
        """Tell what the scene contains: counts of shapes, triangles, plugins, and the settings of its file."""
        return self._core.info()


def load_scene(
    path: str | os.PathLike[str],
    *,
    lenient: bool = False,
    allow_outside: bool = False,
    kernel: str = "auto",
    **params: object,
) -> Scene:
    """Read a Mitsuba 3 scene file.

    Parameters
    ----------
    path : path
        An XML file of version 3.
    lenient : bool
        Whether an unknown plugin or parameter is a warning (see `Scene.warnings`) and not an error.
    allow_outside : bool
        Whether the scene may name files outside its own folder.
    kernel : {"auto", "embree", "wide"}
        What intersects rays: Embree 4 as it comes with the package `embreex`, our own, or the better one at hand.
    **params
        Values for the file's `<default name="…">` parameters; written as the file would write them.

    Returns
    -------
    Scene

    Raises
    ------
    ValueError
        If the file is not a valid scene; the message says file, line and what is known there.
    OSError
        If a file cannot be read.

    Notes
    -----
    The cost is linear in the size of the meshes and textures, plus O(n log n) for the tree over n triangles.
    The format is that of Mitsuba 3, https://mitsuba.readthedocs.io.

    Examples
    --------
    >>> import evenlight
    >>> evenlight.load_scene("scenes/sky.xml").warnings
    ()
    """
    return read_scene(path, params, lenient, allow_outside, kernel)


def read_scene(
    path: str | os.PathLike[str], params: dict[str, object], lenient: bool, allow_outside: bool, kernel: str
) -> Scene:
    """Do as `load_scene` does, for scene parameters of any name."""
    parameters = {name: _as_written(value) for name, value in params.items()}
    core = _core.load_scene(os.fspath(path), parameters, lenient, allow_outside, _embree_library(), kernel)
    return Scene(Path(path), parameters, kernel, tuple(core.warnings), core)


def render(  # every argument is one setting; the settings are the interface
    scene: Scene | str | os.PathLike[str],
    integrator: str = "path",
    sampler: str = "sobol",
    spp: int = 64,
    replicates: int = 4,
    seed: int = 0,
    threads: int | None = None,
    max_depth: int | None = None,
    filter: str | None = None,
    size: tuple[int, int] | None = None,
    mis: str = "power",
    roulette: Roulette = "throughput",
    progress: Progress | None = None,
    kernel: str = "auto",
) -> Film:
    """Render a scene; every pixel of the result carries a standard error.

    Parameters
    ----------
    scene : Scene or path
        What to render. A path is read with `load_scene` first.
    integrator : str
        How light paths are made: a name in the list of `evenlight render --help`.
    sampler : str
        Where the paths' random numbers come from: `"sobol"` (Owen-scrambled), `"halton"`, `"independent"`; of
        `"zsobol"` the errors of neighboring pixels cancel, so that a blur leaves less of them.
    spp : int
        Samples per pixel, the total over all replicates: a multiple of `replicates`. Powers of two per
        replicate suit `"sobol"` best.
    replicates : int
        Independent randomizations, at least 1. Standard errors come from their spread: 4 give a rough one,
        8 or more a good one, 1 none at all (NaN).
    seed : int
        In [0, 2**64). The same seed gives the same bits, whatever the number of threads.
    threads : int, optional
        Worker threads; all cores by default.
    max_depth : int, optional
        The longest path in segments, as Mitsuba counts: 1 is emitters seen directly, -1 is no limit.
        By default as the scene file says.
    filter : str, optional
        The pixel filter, such as `"box"`; by default the scene file's.
    size : (int, int), optional
        Width and height in pixels; by default the scene file's.
    mis : {"power", "balance"}
        The heuristic that weighs light samples against BSDF samples.
    roulette : {"throughput", "none"} or sequence of float
        Which paths end by chance: from the scene file's `rr_depth` on, the more the less they can still bring
        home; none, which needs a `max_depth`; or with these probabilities in (0, 1] a path goes on from its first,
        second, … surface, and with the last one from all further ones. No choice changes the mean;
        `bounce_statistics` helps to choose.
    progress : callable, optional
        Called now and then with a dict: samples `done` and `total`, and the current mean
        `relative_error` (None as long as it is unknown).
    kernel : {"auto", "embree", "wide"}
        The ray kernel, if `scene` is a path; else `load_scene` has chosen it.

    Returns
    -------
    Film
        After an interrupt (Ctrl-C), what there is, with `partial` set.

    Raises
    ------
    ValueError
        If a setting is out of its range or unknown; the message says what is allowed.
    OSError
        If a file of the scene cannot be read.

    Notes
    -----
    The time is proportional to width × height × spp, and about to the mean path length. See `Film` for why
    the error must not be computed from the variance of the samples.

    Examples
    --------
    >>> import evenlight
    >>> film = evenlight.render("scenes/sky.xml", spp=16, size=(8, 8), seed=1)
    >>> bool(abs(film.color[-1, :, 0].mean() - 0.5) < 0.05)
    True
    """
    if not isinstance(scene, Scene):
        scene = load_scene(scene, kernel=kernel)
    elif kernel not in ("auto", scene.kernel):
        raise ValueError(f"the scene was loaded with kernel '{scene.kernel}'; give '{kernel}' to load_scene")
    settings: dict[str, Any] = {
        "integrator": integrator,
        "sampler": sampler,
        "spp": spp,
        "replicates": replicates,
        "seed": seed,
        "threads": threads,
        "max_depth": max_depth,
        "filter": filter,
        "size": size,
        "mis": mis,
        "roulette": _plain_roulette(roulette),
    }
    check_ranges(settings)
    result = _core.render(scene._core, settings, progress)
    about = {"scene": os.fspath(scene.path), "parameters": scene.parameters, "warnings": scene.warnings}
    metadata = settings | about | result["metadata"] | {"version": _core.__version__}
    partial = bool(result.get("partial", False))
    metadata["partial"] = partial
    layers = {name: result[name] for name in ("replicates", "albedo", "normal", "depth")}
    return Film(**layers, metadata=metadata, partial=partial)


_RANGES = {
    "spp": (1, 2**32 - 1),
    "replicates": (1, 2**32 - 1),
    "seed": (0, 2**64 - 1),
    "threads": (1, 4096),
    "max_depth": (-1, 2**31 - 1),
    "width": (1, 2**31 - 1),
    "height": (1, 2**31 - 1),
}


def check_ranges(settings: dict[str, Any]) -> None:
    """Refuse numbers that the core's integers cannot hold, in the words of the settings."""
    numbers = dict(settings)
    if settings["size"] is not None:
        if not isinstance(settings["size"], Sequence) or len(settings["size"]) != 2:
            raise TypeError(f"size must be (width, height), not {settings['size']!r}")
        numbers["width"], numbers["height"] = settings["size"]
    for name, (least, most) in _RANGES.items():
        number = numbers.get(name)
        if number is None:
            continue
        where = f"size: {name}" if name in ("width", "height") else name
        if not isinstance(number, SupportsIndex):
            raise TypeError(f"{where} must be an integer, not {type(number).__name__}")
        if not least <= operator.index(number) <= most:
            raise ValueError(f"{where} is {number}; {least} to {most} is allowed")


def _plain_roulette(roulette: Roulette) -> str | list[float]:
    """Roulette as metadata can hold it."""
    if isinstance(roulette, str):
        return roulette
    try:
        return [float(probability) for probability in roulette]
    except (TypeError, ValueError):
        raise TypeError(f"roulette must be a name or survival probabilities, not {roulette!r}") from None


def _as_written(value: object) -> str:
    """A parameter as a scene file writes it."""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _embree_library() -> str | None:
    """The path of the Embree 4 library inside the package `embreex`, if that is installed."""
    spec = importlib.util.find_spec("embreex")
    if spec is None or spec.origin is None:
        return None
    package = Path(spec.origin).parent
    for folder in (package.with_name("embreex.libs"), package / ".dylibs", package):
        for pattern in ("libembree4*", "embree4*.dll"):
            found = sorted(folder.glob(pattern))
            if found:
                return str(found[0])
    return None
