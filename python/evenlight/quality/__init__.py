"""How even points are, and what that says of an integral: measures of any points of the unit cube.

All but `t_value` and `lattice_error`, which are about nets and lattices, take an array of shape (n, d) with numbers in
[0, 1], whoever made it.
"""

from .l2 import discrepancy
from .lattice_criteria import digital_net_error, lattice_error
from .local import local_discrepancy
from .star import StarDiscrepancy, star_discrepancy, star_discrepancy_cost
from .t_value import t_value

__all__ = [
    "StarDiscrepancy",
    "digital_net_error",
    "discrepancy",
    "lattice_error",
    "local_discrepancy",
    "star_discrepancy",
    "star_discrepancy_cost",
    "t_value",
]
