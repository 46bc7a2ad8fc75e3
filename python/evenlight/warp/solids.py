"""Disks, balls, simplices, cylinders and tori, all places alike."""

from typing import SupportsIndex

from evenlight.arguments import integer

from .base import Warp

__all__ = ["Ball", "Cylinder", "DiskConcentric", "DiskPolar", "Simplex", "Torus"]


class DiskPolar(Warp):
    """The square to the unit disk in polar coordinates: cells near the center are long and thin.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.DiskPolar().map([0.25, 0.0])
    array([0.5, 0. ])
    """

    warp = "disk_polar"


class DiskConcentric(Warp):
    """The square to the unit disk, squares to circles: continuous, with little distortion.

    Prefer it for well-spread points.

    Notes
    -----
    References: P. Shirley and K. Chiu, *A low distortion map between disk and square*, J. Graph. Tools 2(3), 45-52
    (1997).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.DiskConcentric().map([[0.5, 0.5], [0.75, 0.5]])
    array([[0. , 0. ],
           [0.5, 0. ]])
    """

    warp = "disk_concentric"


class Ball(Warp):
    """The cube to the unit ball.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Ball().map([0.0, 0.0, 0.125])
    array([0. , 0. , 0.5])
    """

    warp = "ball"


class Simplex(Warp):
    """The cube to a simplex with dims + 1 corners: barycentric coordinates, uniform.

    Parameters
    ----------
    dims : int
        1 to 64. The density, dims!, is with respect to all coordinates but the first.

    Notes
    -----
    References: K.-T. Fang and Y. Wang, *Number-theoretic methods in statistics*, chapter 1.5 (1994).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Simplex(2).map([0.25, 0.5])
    array([0.5 , 0.25, 0.25])
    """

    warp = "simplex"

    def __init__(self, dims: SupportsIndex) -> None:
        super().__init__(dims=integer("dims", dims, 1, 64))


class Cylinder(Warp):
    """The square to the side of a cylinder around the z axis, from z = 0 upwards.

    Parameters
    ----------
    radius, height : float, default 1
        Positive.

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Cylinder(radius=2.0, height=3.0).map([0.0, 0.5])
    array([2. , 0. , 1.5])
    """

    warp = "cylinder"

    def __init__(self, radius: float = 1.0, height: float = 1.0) -> None:
        super().__init__(radius=float(radius), height=float(height))


class Torus(Warp):
    """The square to the surface of a torus around the z axis, all places alike.

    Parameters
    ----------
    radius : float, default 1
        Of the ring: from the center to the middle of the tube.
    tube : float, default 0.5
        The radius of the tube, at most that of the ring.

    Notes
    -----
    References: P. Diaconis, S. Holmes and M. Shahshahani, *Sampling from a manifold*, IMS Collections 10, 102-125
    (2013).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.Torus().map([[0.0, 0.0], [0.0, 0.5]]).round(6) + 0.0
    array([[1.5, 0. , 0. ],
           [0.5, 0. , 0. ]])
    """

    warp = "torus"

    def __init__(self, radius: float = 1.0, tube: float = 0.5) -> None:
        super().__init__(radius=float(radius), tube=float(tube))
