"""The laboratory: claims of the field as experiments that can be run and judged."""

from .mixture_problems import MixtureProblem, rare_event, singularity
from .rates import Rates, rates
from .rates_table import RATE_CASES, RateCase, rates_table
from .variance_constants import VarianceConstants, variance_constants

__all__ = [
    "RATE_CASES",
    "MixtureProblem",
    "RateCase",
    "Rates",
    "VarianceConstants",
    "rare_event",
    "rates",
    "rates_table",
    "singularity",
    "variance_constants",
]
