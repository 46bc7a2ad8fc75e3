"""Markov chains: kernels, what drives them (random or evenly spread numbers), and what their draws say.

A kernel is plain settings with `dims`, `init` and `step`; the uniform numbers of a step are an argument. `run` runs
chains of any kernel, driven by any sequence.
"""

from .chains import Chains
from .driving import DRIVING, LFSR, Driving, IndependentNumbers
from .kernel import Info, Kernel, State, WarmUp
from .kernels import HMC, KERNELS, MALA, Gibbs, Independence, MetropolisHastings, Proposal, RandomWalk
from .run import run

__all__ = [
    "DRIVING",
    "HMC",
    "KERNELS",
    "LFSR",
    "MALA",
    "Chains",
    "Driving",
    "Gibbs",
    "Independence",
    "IndependentNumbers",
    "Info",
    "Kernel",
    "MetropolisHastings",
    "Proposal",
    "RandomWalk",
    "State",
    "WarmUp",
    "run",
]
