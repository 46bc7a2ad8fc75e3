"""How even points are, and what that says of an integral: measures of lattices and nets."""

from .lattice_criteria import digital_net_error, lattice_error

__all__ = ["digital_net_error", "lattice_error"]
