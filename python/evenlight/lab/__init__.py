"""The laboratory: claims of the field as experiments that can be run and judged."""

from .mixing import LESSONS, FarModes, MixingLesson, crossing_time, far_modes, mixing_lesson, mixing_steps
from .mixture_problems import MixtureProblem, rare_event, singularity
from .rates import Rates, rates
from .rates_table import RATE_CASES, RateCase, rates_table
from .roulette import RouletteResult, RouletteStudy, optimal_survival, roulette_study
from .variance_constants import VarianceConstants, variance_constants

__all__ = [
    "LESSONS",
    "RATE_CASES",
    "FarModes",
    "MixingLesson",
    "MixtureProblem",
    "RateCase",
    "Rates",
    "RouletteResult",
    "RouletteStudy",
    "VarianceConstants",
    "crossing_time",
    "far_modes",
    "mixing_lesson",
    "mixing_steps",
    "optimal_survival",
    "rare_event",
    "rates",
    "rates_table",
    "roulette_study",
    "singularity",
    "variance_constants",
]
