"""Directions: hemispheres, the sphere, caps, and triangles and rectangles as seen from a point."""

from typing import Any

from .arguments import real_array
from .base import Warp

__all__ = ["Cap", "HemisphereCosine", "HemisphereUniform", "Sphere", "SphericalRectangle", "SphericalTriangle"]


class HemisphereUniform(Warp):
    """The square to the upper unit hemisphere, all directions alike.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.HemisphereUniform().map([0.5, 0.0]).round(6)
    array([0.866025, 0.      , 0.5     ])
    """

    warp = "hemisphere_uniform"


class HemisphereCosine(Warp):
    """The square to the upper unit hemisphere with density cos(theta) / pi: how diffuse surfaces scatter.

    The renderer's diffuse lobes are sampled by the same code.

    Notes
    -----
    References: T. Malley, *A shading method for computer generated images*, master's thesis, University of Utah (1988).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.HemisphereCosine().map([0.0, 0.75]).round(6)
    array([0.866025, 0.      , 0.5     ])
    """

    warp = "hemisphere_cosine"


class Sphere(Warp):
    """The square to the unit sphere, all directions alike.

    Examples
    --------
    >>> from evenlight import warp
    >>> round(float(warp.Sphere().density([0.0, 0.6, 0.8])), 6)
    0.079577
    """

    warp = "sphere"


class Cap(Warp):
    """The square to a cap of the unit sphere around +z, all directions alike: spherical lights, cones of spots.

    Parameters
    ----------
    angle : float
        From the center to the rim, in radians: above 0 and at most pi.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Cap(1e-6).map([0.0, 0.0])
    array([0., 0., 1.])
    """

    warp = "cap"

    def __init__(self, angle: float) -> None:
        super().__init__(angle=float(angle))


class SphericalTriangle(Warp):
    """The square to a triangle on the unit sphere, all directions alike: triangular lights by solid angle.

    Parameters
    ----------
    corners : array_like, shape (3, 3)
        Points in the directions of the corners, seen from the origin; not in one plane with it.

    Notes
    -----
    References: J. Arvo, *Stratified sampling of spherical triangles*, SIGGRAPH, 437-438 (1995), with a half-angle
    formula that is precise for small triangles.

    Examples
    --------
    >>> import math
    >>> from evenlight import warp
    >>> octant = warp.SphericalTriangle([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> math.isclose(octant.density([0.6, 0.0, 0.8]), 2 / math.pi)
    True
    """

    warp = "spherical_triangle"

    def __init__(self, corners: Any) -> None:
        super().__init__(corners=real_array("corners", corners, (3, 3)).tolist())


class SphericalRectangle(Warp):
    """The square to a rectangle as seen from the origin, all directions alike: rectangular lights by solid angle.

    Parameters
    ----------
    corners : array_like, shape (3, 3)
        One corner and its two neighbors, at a right angle, in a plane that misses the origin.

    Notes
    -----
    References: C. Urena, M. Fajardo and A. King, *An area-preserving parametrization for spherical rectangles*,
    Comput. Graph. Forum 32(4), 59-66 (2013).

    Examples
    --------
    >>> import math
    >>> from evenlight import warp
    >>> face = warp.SphericalRectangle([[-1, -1, 1], [1, -1, 1], [-1, 1, 1]])  # a face of a cube around the origin
    >>> math.isclose(face.density([0.0, 0.0, 1.0]), 6 / (4 * math.pi))
    True
    """

    warp = "spherical_rectangle"

    def __init__(self, corners: Any) -> None:
        super().__init__(corners=real_array("corners", corners, (3, 3)).tolist())
