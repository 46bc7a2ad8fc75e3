"""State-space models that are ready. One model, one file."""

from evenlight.smc.state_space import StateSpaceModel

from .linear_gaussian import LinearGaussian
from .stochastic_volatility import StochasticVolatility

__all__ = ["MODELS", "LinearGaussian", "StochasticVolatility"]

MODELS: dict[str, type[StateSpaceModel]] = {
    "linear_gaussian": LinearGaussian,
    "stochastic_volatility": StochasticVolatility,
}
"""The classes by their names."""
