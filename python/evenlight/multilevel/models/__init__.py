"""Coupled models, ready to use: what levels are of, and with which variance they differ. One model, one file.

`MODELS` lists those with one direction of refinement, `INDEXED_MODELS` those with two.
"""

from typing import Any

from evenlight.multilevel.level_sampler import LevelSampler, MultiIndexSampler

from .clark_cameron import ClarkCameron
from .diffusion_1d import Diffusion1D, IndexedDiffusion1D
from .diffusion_2d import Diffusion2D, IndexedDiffusion2D
from .fields import FIELDS, Field, LogNormalField, UniformField
from .formats import FORMATS, Arithmetic, FixedPoint, NativeFloat, RoundedFloat
from .gbm import GeometricBrownianMotion
from .heston import Heston, HestonTerms, heston_call
from .mixed_precision import EulerCall, MixedPrecision
from .nested_expectation import NestedExpectation, partial_information
from .option import Option, black_scholes_call
from .payoffs import PAYOFFS
from .reaction_paths import ReactionPaths
from .reactions.gene_transcription import gene_transcription
from .reactions.network import ReactionNetwork
from .reactions.poisson import poisson
from .reactions.streams import Streams
from .sde import StochasticDifferentialEquation

__all__ = [
    "FIELDS",
    "FORMATS",
    "INDEXED_MODELS",
    "MODELS",
    "PAYOFFS",
    "Arithmetic",
    "ClarkCameron",
    "Diffusion1D",
    "Diffusion2D",
    "EulerCall",
    "Field",
    "FixedPoint",
    "GeometricBrownianMotion",
    "Heston",
    "HestonTerms",
    "IndexedDiffusion1D",
    "IndexedDiffusion2D",
    "LogNormalField",
    "MixedPrecision",
    "NativeFloat",
    "NestedExpectation",
    "Option",
    "ReactionNetwork",
    "ReactionPaths",
    "RoundedFloat",
    "StochasticDifferentialEquation",
    "Streams",
    "UniformField",
    "black_scholes_call",
    "build",
    "gene_transcription",
    "heston_call",
    "partial_information",
    "poisson",
]

MODELS: dict[str, type[LevelSampler]] = {
    "gbm": GeometricBrownianMotion,
    "sde": StochasticDifferentialEquation,
    "heston": Heston,
    "clark_cameron": ClarkCameron,
    "reaction_paths": ReactionPaths,
    "nested_expectation": NestedExpectation,
    "diffusion_1d": Diffusion1D,
    "diffusion_2d": Diffusion2D,
    "mixed_precision": MixedPrecision,
}
"""The models by the names of their files."""

INDEXED_MODELS: dict[str, type[MultiIndexSampler]] = {
    "diffusion_1d": IndexedDiffusion1D,
    "diffusion_2d": IndexedDiffusion2D,
}
"""Those with two directions of refinement, likewise."""


def build(name: str, *arguments: Any, **settings: Any) -> LevelSampler:
    """Build a model by its name.

    Parameters
    ----------
    name : str
        One of `MODELS`.
    *arguments, **settings
        What the model asks.

    Returns
    -------
    LevelSampler
        For any method of `evenlight.multilevel`.

    Raises
    ------
    ValueError
        If the name is unknown, or a setting is impossible.

    Examples
    --------
    >>> from evenlight.multilevel import models
    >>> models.build("gbm", "asian", strike=110.0).name
    'gbm asian milstein'
    """
    if name not in MODELS:
        raise ValueError(f"unknown model {name!r}; known: {', '.join(MODELS)}")
    return MODELS[name](*arguments, **settings)
