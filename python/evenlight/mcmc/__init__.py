"""Markov chains: kernels, what drives them (random or evenly spread numbers), and what their draws say.

A kernel is plain settings with `dims`, `init` and `step`; the uniform numbers of a step are an argument. `run` runs
chains of any kernel, driven by any sequence.
"""

from .chains import Chains
from .diagnostics import Diagnostics
from .driving import DRIVING, LCG, LFSR, Antithetic, Driving, IndependentNumbers, Permuted, Stratified
from .expected_values import expected_value_integral
from .kernel import Info, Kernel, State, WarmUp
from .kernels import (
    HMC,
    KERNELS,
    MALA,
    DelayedRejection,
    Gibbs,
    HerdedGibbs,
    Independence,
    MetropolisHastings,
    Microcanonical,
    MultipleTry,
    ParallelTempering,
    PrimarySampleSpace,
    Proposal,
    RandomWalk,
    Slice,
)
from .ladder import Ladder, tempering_ladder
from .nuts import NUTS
from .plots import RankRecord, TraceRecord, rank_figure, rank_record, trace_figure, trace_record
from .run import run

__all__ = [
    "DRIVING",
    "HMC",
    "KERNELS",
    "LCG",
    "LFSR",
    "MALA",
    "NUTS",
    "Antithetic",
    "Chains",
    "DelayedRejection",
    "Diagnostics",
    "Driving",
    "Gibbs",
    "HerdedGibbs",
    "Independence",
    "IndependentNumbers",
    "Info",
    "Kernel",
    "Ladder",
    "MetropolisHastings",
    "Microcanonical",
    "MultipleTry",
    "ParallelTempering",
    "Permuted",
    "PrimarySampleSpace",
    "Proposal",
    "RandomWalk",
    "RankRecord",
    "Slice",
    "State",
    "Stratified",
    "TraceRecord",
    "WarmUp",
    "expected_value_integral",
    "rank_figure",
    "rank_record",
    "run",
    "tempering_ladder",
    "trace_figure",
    "trace_record",
]
