"""Markov kernels: plain settings with `init`, `dims` and `step`. One kernel, one file."""

from evenlight.mcmc.kernel import Kernel

from .delayed_rejection import DelayedRejection
from .gibbs import Gibbs
from .herded_gibbs import HerdedGibbs
from .hmc import HMC
from .independence import Independence
from .mala import MALA
from .metropolis_hastings import MetropolisHastings, Proposal
from .microcanonical import Microcanonical
from .multiple_try import MultipleTry
from .parallel_tempering import ParallelTempering
from .primary_sample_space import PrimarySampleSpace
from .random_walk import RandomWalk
from .slice import Slice

__all__ = [
    "HMC",
    "KERNELS",
    "MALA",
    "DelayedRejection",
    "Gibbs",
    "HerdedGibbs",
    "Independence",
    "MetropolisHastings",
    "Microcanonical",
    "MultipleTry",
    "ParallelTempering",
    "PrimarySampleSpace",
    "Proposal",
    "RandomWalk",
    "Slice",
]

_ALL: tuple[type[Kernel], ...] = (
    RandomWalk,
    Independence,
    MetropolisHastings,
    Gibbs,
    HMC,
    MALA,
    Microcanonical,
    Slice,
    ParallelTempering,
    DelayedRejection,
    MultipleTry,
    HerdedGibbs,
    PrimarySampleSpace,
)

KERNELS: dict[str, type[Kernel]] = {kernel.name: kernel for kernel in _ALL}
"""The classes by their names."""
