"""evenlight: a sampling engine for image synthesis.

Rooms such as `evenlight.points` and functions such as `evenlight.render` are loaded when they are first asked for.

Examples
--------
>>> import evenlight
>>> film = evenlight.render("scenes/sky.xml", spp=16, size=(8, 8))
>>> film.color.shape, film.standard_error.shape
((8, 8, 3), (8, 8, 3))
"""

from importlib import import_module
from typing import TYPE_CHECKING

from evenlight._core import __version__

__all__ = [
    "BounceStatistics",
    "Estimate",
    "Film",
    "Scene",
    "__version__",
    "blue_noise",
    "bounce_statistics",
    "domains",
    "importance",
    "integrands",
    "integrate",
    "lab",
    "load_scene",
    "mcmc",
    "multilevel",
    "points",
    "quality",
    "quantile",
    "reduction",
    "render",
    "smc",
    "warp",
]

if TYPE_CHECKING:
    from evenlight import (
        blue_noise,
        domains,
        importance,
        integrands,
        lab,
        mcmc,
        multilevel,
        points,
        quality,
        reduction,
        smc,
        warp,
    )
    from evenlight.bounces import BounceStatistics, bounce_statistics
    from evenlight.estimate import Estimate
    from evenlight.integration import integrate
    from evenlight.quantiles import quantile
    from evenlight.rendering import Film, Scene, load_scene, render
else:
    _MODULES = {
        "BounceStatistics": "bounces",
        "Estimate": "estimate",
        "Film": "rendering",
        "Scene": "rendering",
        "bounce_statistics": "bounces",
        "integrate": "integration",
        "load_scene": "rendering",
        "quantile": "quantiles",
        "render": "rendering",
    }

    def __getattr__(name: str) -> object:
        if name not in __all__:
            raise AttributeError(f"module 'evenlight' has no attribute {name!r}")
        if name in _MODULES:
            return getattr(import_module(f"evenlight.{_MODULES[name]}"), name)
        return import_module(f"evenlight.{name}")

    def __dir__() -> list[str]:
        return __all__
