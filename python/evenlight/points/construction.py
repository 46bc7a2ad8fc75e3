"""Construction of lattices: generating vectors that are good for the weights of a problem."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Literal, SupportsFloat, SupportsIndex

from evenlight import _core

__all__ = ["construct_korobov", "construct_lattice", "construct_polynomial_lattice"]


def construct_lattice(
    d: SupportsIndex,
    n: SupportsIndex,
    *,
    least: SupportsIndex | None = None,
    weights: Sequence[SupportsFloat] | None = None,
    space: Literal["sobolev", "korobov"] = "sobolev",
    smoothness: SupportsIndex = 2,
) -> list[int]:
    """Construct the generating vector of a rank-1 lattice, component by component.

    Every number in turn is the one with the least squared worst-case error, `evenlight.quality.lattice_error`, with
    those chosen before.

    Parameters
    ----------
    d : int
        The number of coordinates, at least 1.
    n : int
        The number of points: a prime or a power of 2, up to 2^28.
    least : int, optional
        A power of 2 up to n, another one. The vector is then good for all powers of 2 between, in the worst
        ratio of its error to that of the best vector for so many points: for ``Lattice(d, generator=...)``.
    weights : sequence of d float, optional
        How much each coordinate matters, positive; 1 / j² by default.
    space : {"sobolev", "korobov"}
        The functions whose error is least: "sobolev" with mixed first derivatives, under a random shift; "korobov"
        periodic ones, for which it is the weighted P_α.
    smoothness : {2, 4, 6}
        The α of "korobov".

    Returns
    -------
    list of int
        One number for each coordinate, the first is 1.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    In time d n log n and memory for n numbers: measured, 1.5 seconds for d = 100 and n = 2^20, 2.8 with ``least=1024``;
    a prime takes 5.3. The same vector on every machine.

    References: D. Nuyens and R. Cools, Math. Comp. 75, 903-920 (2006); R. Cools, F. Y. Kuo and D. Nuyens, SIAM J. Sci.
    Comput. 28, 2162-2188 (2006).

    Examples
    --------
    >>> from evenlight.points import Lattice, construct_lattice
    >>> z = construct_lattice(3, 1021, weights=[1, 0.5, 0.25])
    >>> Lattice(3, n=1021, generator=z, seed=7).points(0, 1021).shape
    (1021, 3)
    """
    dims, count = _positive("d", d), _positive("n", n)
    first = None if least is None else _positive("least", least)
    return _core.construct_lattice(count, first, _weights(weights, dims), space, operator.index(smoothness))


def construct_polynomial_lattice(
    d: SupportsIndex,
    n: SupportsIndex,
    *,
    least: SupportsIndex | None = None,
    weights: Sequence[SupportsFloat] | None = None,
) -> list[int]:
    """Construct the generating polynomials of a polynomial lattice in base 2, component by component.

    Every polynomial in turn has the least squared worst-case error, averaged over digital shifts
    (`evenlight.quality.digital_net_error`), with those chosen before.

    Parameters
    ----------
    d : int
        The number of coordinates, at least 1.
    n : int
        The number of points, a power of 2 up to 2^24; the modulus is a power of x.
    least : int, optional
        A power of 2 up to n. The polynomials are then good for all powers of 2 between.
    weights : sequence of d float, optional
        How much each coordinate matters, positive; 1 / j² by default.

    Returns
    -------
    list of int
        One polynomial for each coordinate, bit i the coefficient of x^i; the first is 1.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    In time d n log n: measured, 4.4 seconds for d = 100 and n = 2^20.

    References: J. Dick, F. Y. Kuo, F. Pillichshammer and I. H. Sloan, Math. Comp. 74, 1895-1921 (2005); J. Dick and F.
    Pillichshammer, J. Complexity 21, 149-195 (2005).

    Examples
    --------
    >>> from evenlight.points import PolynomialLattice, construct_polynomial_lattice
    >>> q = construct_polynomial_lattice(3, 1024, weights=[1, 0.5, 0.25])
    >>> PolynomialLattice(3, generator=q, seed=7).points(0, 1024).shape
    (1024, 3)
    """
    dims, count = _positive("d", d), _positive("n", n)
    first = None if least is None else _positive("least", least)
    return _core.construct_polynomial_lattice(count, first, _weights(weights, dims))


def construct_korobov(
    d: SupportsIndex,
    n: SupportsIndex,
    *,
    weights: Sequence[SupportsFloat] | None = None,
    space: Literal["sobolev", "korobov"] = "sobolev",
    smoothness: SupportsIndex = 2,
    candidates: SupportsIndex = 64,
) -> int:
    """Search the number a of a Korobov lattice with the least squared worst-case error.

    Parameters
    ----------
    d : int
        The number of coordinates, at least 1.
    n : int
        The number of points, at least 1.
    weights, space, smoothness
        As for `construct_lattice`.
    candidates : int, optional
        How many numbers are tried: a fixed selection, or all if n is at most twice as large.

    Returns
    -------
    int
        The best of them.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    In time n d `candidates`: measured, 2 to 5 nanoseconds times that.

    Examples
    --------
    >>> from evenlight.points import Korobov, construct_korobov
    >>> a = construct_korobov(4, 1021)
    >>> Korobov(4, n=1021, generator=[a], seed=7).points(0, 1021).shape
    (1021, 4)
    """
    dims, count, tried = _positive("d", d), _positive("n", n), _positive("candidates", candidates)
    return _core.construct_korobov(count, _weights(weights, dims), space, operator.index(smoothness), tried)


def _positive(name: str, value: SupportsIndex) -> int:
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if not 1 <= number < 2**64:
        raise ValueError(f"{name} must be 1 to 2^64 - 1, not {number}")
    return number


def _weights(weights: Sequence[SupportsFloat] | None, dims: int) -> list[float]:
    if weights is None:
        return [1.0 / j**2 for j in range(1, dims + 1)]
    numbers = [float(weight) for weight in weights]
    if len(numbers) != dims:
        raise ValueError(f"weights must be {dims} numbers, one for each coordinate, not {len(numbers)}")
    return numbers
