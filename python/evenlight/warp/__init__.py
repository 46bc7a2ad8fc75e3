"""Where light needs points: maps of uniform numbers with density and inverse, and points of triangles.

A warp has `map`, `density` and `invert`, on arrays in either precision: ``TriangleHeitz().map(u)``. `available` lists
them. Functions make points of triangles, `triangle_van_der_corput`, `triangle_kronecker`, `triangle_product`, and
points along space-filling curves, `curve_points`; `hilbert_sort` puts clouds in order.
"""

from typing import Any, NamedTuple

from evenlight import _core

from .base import Warp
from .curves import (
    Gray,
    Hilbert,
    Morton,
    curve_cells,
    curve_index,
    curve_points,
    curve_sort,
    hilbert,
    hilbert_inverse,
    hilbert_sort,
)
from .directions import Cap, HemisphereCosine, HemisphereUniform, Sphere, SphericalRectangle, SphericalTriangle
from .distributions import Discrete, DiscreteAlias, Frozen, Gaussian, Image, PiecewiseConstant, PiecewiseLinear
from .solids import Ball, Cylinder, DiskConcentric, DiskPolar, Simplex, Torus
from .triangle import triangle_kronecker, triangle_product, triangle_van_der_corput
from .triangle_maps import TriangleHeitz, TriangleMirror, TriangleQuaternary, TriangleRoot, TriangleSort

__all__ = [
    "WARPS",
    "Ball",
    "Cap",
    "Cylinder",
    "Discrete",
    "DiscreteAlias",
    "DiskConcentric",
    "DiskPolar",
    "Frozen",
    "Gaussian",
    "Gray",
    "HemisphereCosine",
    "HemisphereUniform",
    "Hilbert",
    "Image",
    "Morton",
    "PiecewiseConstant",
    "PiecewiseLinear",
    "Simplex",
    "Sphere",
    "SphericalRectangle",
    "SphericalTriangle",
    "Torus",
    "TriangleHeitz",
    "TriangleMirror",
    "TriangleQuaternary",
    "TriangleRoot",
    "TriangleSort",
    "Warp",
    "WarpInfo",
    "available",
    "build",
    "curve_cells",
    "curve_index",
    "curve_points",
    "curve_sort",
    "hilbert",
    "hilbert_inverse",
    "hilbert_sort",
    "triangle_kronecker",
    "triangle_product",
    "triangle_van_der_corput",
]

WARPS: dict[str, type[Warp]] = {
    warp.warp: warp
    for warp in (
        TriangleRoot,
        TriangleHeitz,
        TriangleMirror,
        TriangleSort,
        TriangleQuaternary,
        Hilbert,
        Morton,
        Gray,
        DiskPolar,
        DiskConcentric,
        HemisphereUniform,
        HemisphereCosine,
        Sphere,
        Cap,
        Ball,
        Simplex,
        Cylinder,
        Torus,
        SphericalTriangle,
        SphericalRectangle,
        Gaussian,
        PiecewiseLinear,
        PiecewiseConstant,
        Discrete,
        DiscreteAlias,
        Image,
    )
}
"""The classes by their names in the registry."""


class WarpInfo(NamedTuple):
    """What a warp says about itself."""

    name: str
    """Its name everywhere."""
    cite: str
    """Where it was published."""
    options: tuple[str, ...]
    """The options it takes."""
    folds: bool
    """Whether several places of the cube lead to one point, so that `invert` has to choose."""


def available() -> tuple[WarpInfo, ...]:
    """List the warps.

    Returns
    -------
    tuple of WarpInfo
        Name, citation, options of each, and whether it folds the cube.

    Examples
    --------
    >>> from evenlight import warp
    >>> [info.name for info in warp.available()][:2]
    ['triangle_root', 'triangle_heitz']
    """
    return tuple(WarpInfo(name, cite, tuple(options), folds) for name, cite, options, folds in _core.available_warps())


def build(name: str, **options: Any) -> Warp:
    """Build a warp from plain values, such as those of a settings file.

    Parameters
    ----------
    name : str
        One of `available`.
    **options
        What the warp asks.

    Returns
    -------
    Warp
        One of the classes in `WARPS`.

    Raises
    ------
    TypeError, ValueError
        If the name is unknown or an option wrong; the message says what is allowed.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.build("triangle_heitz")
    TriangleHeitz()
    """
    if name not in WARPS:
        raise ValueError(f"unknown warp {name!r}; known: {', '.join(WARPS)}")
    return WARPS[name](**options)
