"""Maps of the square, or of the interval, to a triangle: barycentric coordinates, density 2 in any two of them."""

from .base import Warp

__all__ = ["TriangleHeitz", "TriangleMirror", "TriangleQuaternary", "TriangleRoot", "TriangleSort"]


class TriangleRoot(Warp):
    """The square to a triangle by a square root: continuous and one to one, with one side squeezed into a corner.

    Notes
    -----
    References: G. Turk, *Generating random points in triangles*, Graphics Gems, 24-28 (1990).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.TriangleRoot().map([0.25, 0.5])
    array([0.5 , 0.25, 0.25])
    """

    warp = "triangle_root"


class TriangleHeitz(Warp):
    """The square to a triangle with little distortion: two linear maps that meet on the diagonal, no root.

    Notes
    -----
    References: E. Heitz, *A low-distortion map between triangle and square*, hal-02073696 (2019).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.TriangleHeitz().map([0.25, 0.75])
    array([0.125, 0.625, 0.25 ])
    """

    warp = "triangle_heitz"


class TriangleMirror(Warp):
    """The square to a triangle by reflecting its upper half: linear, but two to one.

    Notes
    -----
    References: T. Pillards and R. Cools, *Transforming low-discrepancy sequences from a cube to a simplex*,
    J. Comput. Appl. Math. 174, 29-42 (2005).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.TriangleMirror().map([0.75, 0.5])
    array([0.25, 0.25, 0.5 ])
    """

    warp = "triangle_mirror"


class TriangleSort(Warp):
    """The square to a triangle by sorting two numbers: continuous, but two to one.

    Notes
    -----
    References: T. Pillards and R. Cools, *Transforming low-discrepancy sequences from a cube to a simplex*,
    J. Comput. Appl. Math. 174, 29-42 (2005).

    Examples
    --------
    >>> from evenlight import warp
    >>> warp.TriangleSort().map([0.75, 0.5])
    array([0.5 , 0.25, 0.25])
    """

    warp = "triangle_sort"


class TriangleQuaternary(Warp):
    """The interval to a triangle: digits in base 4 choose nested triangles. One to one, but not continuous.

    Notes
    -----
    References: K. Basu and A. B. Owen, *Low discrepancy constructions in the triangle*, SIAM J. Numer. Anal. 53(2),
    743-761 (2015).

    Examples
    --------
    >>> from evenlight import warp
    >>> 6 * warp.TriangleQuaternary().map([[0.25], [0.5]])
    array([[4., 1., 1.],
           [1., 4., 1.]])
    """

    warp = "triangle_quaternary"
