"""Blue noise: points that keep their distance without a grid, dither masks, and errors that are blue on the screen.

`poisson_disk`, `sample_elimination` and `gaussian` make points of the torus [0, 1)^d; `available` lists them. Of
the first two every beginning is as well spread as a set of its own. `dither_mask` orders the pixels of an image so
that every threshold leaves blue noise, and `pixel_places` numbers them so that errors of neighbors cancel. All is a
function of the seed, whatever the threads. `evenlight.quality` has spectra and pair correlations to judge it by.
"""

from typing import NamedTuple

from evenlight import _core

from .points import gaussian, poisson_disk, relaxed, sample_elimination
from .screen import dither_mask, pixel_places

__all__ = [
    "BlueNoiseInfo",
    "available",
    "dither_mask",
    "gaussian",
    "pixel_places",
    "poisson_disk",
    "relaxed",
    "sample_elimination",
]


class BlueNoiseInfo(NamedTuple):
    """What a way to make blue noise says about itself."""

    name: str
    """Its name everywhere."""
    cite: str
    """Where it was published."""
    progressive: bool
    """Whether every beginning of its points is well spread."""
    effort: str
    """What work is counted in."""
    usual: int
    """How much of it is usual."""


def available() -> tuple[BlueNoiseInfo, ...]:
    """List the ways to make points of blue noise.

    Returns
    -------
    tuple of BlueNoiseInfo
        Name, citation, whether it is progressive, and what its work is counted in.

    Examples
    --------
    >>> from evenlight import blue_noise
    >>> [info.name for info in blue_noise.available() if info.progressive]
    ['poisson_disk', 'sample_elimination']
    """
    return tuple(BlueNoiseInfo(*info) for info in _core.available_blue_noise())
