"""Driving sequences: the uniform numbers that chains are driven by. One sequence, one file.

`LFSR`, `LCG` and `Permuted` of ever more steps are rows of (weakly) completely uniformly distributed triangular
arrays; what is proven of chains so driven is said of `LFSR`. `Antithetic` and `Stratified` couple chains.
"""

from .antithetic import Antithetic
from .independent import IndependentNumbers
from .lcg import LCG
from .lfsr import LFSR
from .permuted import Permuted
from .protocol import Driving
from .stratified import Stratified

__all__ = ["DRIVING", "LCG", "LFSR", "Antithetic", "Driving", "IndependentNumbers", "Permuted", "Stratified"]

DRIVING: dict[str, type[Driving]] = {
    driving.name: driving for driving in (IndependentNumbers, LFSR, LCG, Permuted, Antithetic, Stratified)
}
"""The classes by their names."""
