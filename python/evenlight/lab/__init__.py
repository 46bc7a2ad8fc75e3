"""The laboratory: claims of the field as experiments that can be run and judged."""

from .mixing import LESSONS, FarModes, MixingLesson, crossing_time, far_modes, mixing_lesson, mixing_steps
from .mixture_problems import MixtureProblem, rare_event, singularity
from .rates import Rates, rates
from .rates_table import RATE_CASES, RateCase, rates_table
from .variance_constants import VarianceConstants, variance_constants

__all__ = [
    "LESSONS",
    "RATE_CASES",
    "FarModes",
    "MixingLesson",
    "MixtureProblem",
    "RateCase",
    "Rates",
    "VarianceConstants",
    "crossing_time",
    "far_modes",
    "mixing_lesson",
    "mixing_steps",
    "rare_event",
    "rates",
    "rates_table",
    "singularity",
    "variance_constants",
]
