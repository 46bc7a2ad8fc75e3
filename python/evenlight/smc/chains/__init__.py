"""Markov chains that are ready, with exact answers. One chain, one file."""

from .asian_option import AsianOptionChain
from .autoregressive import AutoregressiveChain
from .chain import MarkovChain
from .lindley_queue import LindleyQueue

__all__ = ["CHAINS", "AsianOptionChain", "AutoregressiveChain", "LindleyQueue", "MarkovChain"]

CHAINS: dict[str, type[MarkovChain]] = {
    "autoregressive": AutoregressiveChain,
    "lindley_queue": LindleyQueue,
    "asian_option": AsianOptionChain,
}
"""The classes by their names."""
