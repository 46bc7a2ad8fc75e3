"""Markov kernels: plain settings with `init`, `dims` and `step`. One kernel, one file."""

from evenlight.mcmc.kernel import Kernel

from .gibbs import Gibbs
from .hmc import HMC
from .independence import Independence
from .mala import MALA
from .metropolis_hastings import MetropolisHastings, Proposal
from .random_walk import RandomWalk

__all__ = ["HMC", "KERNELS", "MALA", "Gibbs", "Independence", "MetropolisHastings", "Proposal", "RandomWalk"]

KERNELS: dict[str, type[Kernel]] = {
    kernel.name: kernel for kernel in (RandomWalk, Independence, MetropolisHastings, Gibbs, HMC, MALA)
}
"""The classes by their names."""
