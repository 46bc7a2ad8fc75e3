"""Where to look: point sequences of the unit cube, deterministic in their seed.

`Sobol` for integration, `Halton` for any number of points, `Independent` as the yardstick. All follow
`scipy.stats.qmc.QMCEngine` and have random access besides: ``Sobol(3, seed=7).points(1000, 2000)``.
"""

from typing import Any, NamedTuple, SupportsIndex

from evenlight import _core

from .construction import construct_korobov, construct_lattice, construct_polynomial_lattice
from .correlated_multi_jittered import CorrelatedMultiJittered
from .digital_net import DigitalNet
from .dyadic import Dyadic
from .engine import Engine, SeedLike
from .faure import Faure
from .fibonacci import Fibonacci
from .halton import Halton
from .hammersley import Hammersley
from .independent import Independent
from .interlaced_sobol import InterlacedSobol
from .korobov import Korobov
from .kronecker import Kronecker
from .latin_hypercube import LatinHypercube
from .lattice import Lattice
from .mersenne_twister import MersenneTwister
from .multi_jittered import MultiJittered
from .net_tables import read_direction_numbers, read_matrices
from .niederreiter import Niederreiter
from .niederreiter_xing import NiederreiterXing
from .orthogonal_array import OrthogonalArray
from .pcg import Pcg
from .philox import Philox
from .polynomial_lattice import PolynomialLattice
from .progressive_multi_jittered import ProgressiveMultiJittered
from .sobol import Sobol
from .sobol_tkrg import SobolTkrg
from .stratified import Stratified
from .sz import Sz
from .van_der_corput import VanDerCorput

__all__ = [
    "SEQUENCES",
    "CorrelatedMultiJittered",
    "DigitalNet",
    "Dyadic",
    "Engine",
    "Faure",
    "Fibonacci",
    "Halton",
    "Hammersley",
    "Independent",
    "InterlacedSobol",
    "Korobov",
    "Kronecker",
    "LatinHypercube",
    "Lattice",
    "MersenneTwister",
    "MultiJittered",
    "Niederreiter",
    "NiederreiterXing",
    "OrthogonalArray",
    "Pcg",
    "Philox",
    "PolynomialLattice",
    "ProgressiveMultiJittered",
    "SequenceInfo",
    "Sobol",
    "SobolTkrg",
    "Stratified",
    "Sz",
    "VanDerCorput",
    "available",
    "build",
    "construct_korobov",
    "construct_lattice",
    "construct_polynomial_lattice",
    "read_direction_numbers",
    "read_matrices",
]

SEQUENCES: dict[str, type[Engine]] = {
    sequence.sequence: sequence
    for sequence in (
        Sobol,
        Halton,
        Independent,
        NiederreiterXing,
        SobolTkrg,
        InterlacedSobol,
        DigitalNet,
        VanDerCorput,
        Hammersley,
        Faure,
        Niederreiter,
        Dyadic,
        Sz,
        ProgressiveMultiJittered,
        Lattice,
        PolynomialLattice,
        Kronecker,
        Korobov,
        Fibonacci,
        LatinHypercube,
        OrthogonalArray,
        Stratified,
        MultiJittered,
        CorrelatedMultiJittered,
        Philox,
        Pcg,
        MersenneTwister,
    )
}
"""The classes by their names in the registry."""


class SequenceInfo(NamedTuple):
    """What a sequence says about itself."""

    name: str
    """Its name everywhere."""
    cite: str
    """Where it was published."""
    scrambles: tuple[str, ...]
    """The scrambles it takes, its default first."""
    options: tuple[str, ...]
    """The options it takes."""
    most_dims: int
    """The most dimensions it has."""


def available() -> tuple[SequenceInfo, ...]:
    """List the sequences.

    Returns
    -------
    tuple of SequenceInfo
        Name, citation, accepted scrambles (default first), options and most dimensions of each.

    Examples
    --------
    >>> from evenlight import points
    >>> [info.name for info in points.available()][:3]
    ['sobol', 'halton', 'independent']
    """
    return tuple(
        SequenceInfo(name, cite, tuple(scrambles), tuple(options), most_dims)
        for name, cite, scrambles, options, most_dims in _core.available_sequences()
    )


def build(name: str, d: SupportsIndex, *, scramble: str | None = None, seed: SeedLike = None, **options: Any) -> Engine:
    """Build a sequence from plain values, such as those of a settings file.

    Parameters
    ----------
    name : str
        One of `available`.
    d : int
        The number of coordinates of a point.
    scramble : str, optional
        One that the sequence takes; its first by default.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.
    **options
        What the sequence asks besides, such as the number of points `n` of a finite set.

    Returns
    -------
    Engine
        One of the classes in `SEQUENCES`.

    Raises
    ------
    TypeError, ValueError
        If a name is unknown or an argument out of range; the message says what is allowed.

    Examples
    --------
    >>> from evenlight import points
    >>> points.build("halton", 2, seed=3)
    Halton(2, scramble='owen', seed=3)
    """
    infos = {info.name: info for info in available()}
    if name not in infos:
        raise ValueError(f"unknown sequence {name!r}; known: {', '.join(infos)}")
    info = infos[name]
    for option in options:
        if option not in info.options:
            known = ", ".join(info.options) or "none"
            raise ValueError(f"sequence {name!r} has no option {option!r}; it has: {known}")
    if scramble is not None and scramble not in info.scrambles:
        accepted = ", ".join(info.scrambles)
        raise ValueError(f"sequence {name!r} does not accept scramble {scramble!r}; accepted: {accepted}")
    # a sequence with a single scramble has no such argument
    chosen: dict[str, Any] = {} if scramble is None or len(info.scrambles) == 1 else {"scramble": scramble}
    return SEQUENCES[name](d, seed=seed, **chosen, **options)
