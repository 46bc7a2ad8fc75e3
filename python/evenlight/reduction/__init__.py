"""Variance reduction: the same integral with less error for the same work. One method, one file."""

from .antithetic import antithetic
from .conditional import conditional
from .control_variates import control_variates
from .ratio import ratio
from .stratified import Stratum, stratified

__all__ = ["Stratum", "antithetic", "conditional", "control_variates", "ratio", "stratified"]
