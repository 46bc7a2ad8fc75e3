"""evenlight: a sampling engine for image synthesis.

Examples
--------
>>> import evenlight
>>> film = evenlight.render("scenes/sky.xml", spp=16, size=(8, 8))
>>> film.color.shape, film.standard_error.shape
((8, 8, 3), (8, 8, 3))
"""

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
from evenlight._core import __version__
from evenlight.estimate import Estimate
from evenlight.integrate import integrate
from evenlight.quantiles import quantile
from evenlight.render import Film, Scene, load_scene, render

__all__ = [
    "Estimate",
    "Film",
    "Scene",
    "__version__",
    "blue_noise",
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
