"""Driving sequences: the uniform numbers that chains are driven by. One sequence, one file."""

from .independent import IndependentNumbers
from .lfsr import LFSR
from .protocol import Driving

__all__ = ["DRIVING", "LFSR", "Driving", "IndependentNumbers"]

DRIVING: dict[str, type[Driving]] = {driving.name: driving for driving in (IndependentNumbers, LFSR)}
"""The classes by their names."""
