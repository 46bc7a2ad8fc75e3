"""Payoffs of paths of one asset. One payoff, one file; `PAYOFFS` lists them."""

from .asian import Asian
from .barrier import Barrier
from .digital import Digital
from .european import European
from .lookback import Lookback
from .payoff import Payoff

__all__ = ["PAYOFFS", "Payoff"]

PAYOFFS: dict[str, type[Payoff]] = {payoff.name: payoff for payoff in (European, Asian, Lookback, Barrier, Digital)}
"""The classes by their names."""
