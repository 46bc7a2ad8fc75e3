"""The laboratory: claims of the field as experiments that can be run and judged."""

from .keynote_mixtures import MixtureProblem, rare_event, singularity
from .keynote_rates import RATE_CASES, RateCase, keynote_rates
from .rates import Rates, rates
from .variance_constants import VarianceConstants, variance_constants

__all__ = [
    "RATE_CASES",
    "MixtureProblem",
    "RateCase",
    "Rates",
    "VarianceConstants",
    "keynote_rates",
    "rare_event",
    "rates",
    "singularity",
    "variance_constants",
]
