"""The laboratory: claims of the field as experiments that can be run and judged."""

from .keynote_mixtures import MixtureProblem, rare_event, singularity
from .variance_constants import VarianceConstants, variance_constants

__all__ = ["MixtureProblem", "VarianceConstants", "rare_event", "singularity", "variance_constants"]
