"""How even points are, and what that says of an integral: measures of any points of the unit cube.

All but `t_value` and `lattice_error`, which are about nets and lattices, take an array of shape (n, d) with numbers
in [0, 1], whoever made it.
"""

from .boxes import EmptyBox, ExtremeDiscrepancy, dispersion, extreme_discrepancy
from .effective import EffectiveDimension, effective_dimension
from .isotropic import IsotropicDiscrepancy, isotropic_discrepancy
from .l2 import discrepancy
from .lattice_criteria import digital_net_error, lattice_error
from .local import local_discrepancy
from .nets import gain_coefficients, is_net, smallest_t
from .sensitivity import SobolIndices, sobol_indices
from .spectrum import PairCorrelation, RadialSpectrum, minimum_distance, pair_correlation, periodogram, radial_spectrum
from .star import StarDiscrepancy, star_discrepancy, star_discrepancy_cost
from .t_value import t_value
from .triangle import triangle_discrepancy
from .variation import Variation, hardy_krause_variation, koksma_hlawka_bound

__all__ = [
    "EffectiveDimension",
    "EmptyBox",
    "ExtremeDiscrepancy",
    "IsotropicDiscrepancy",
    "PairCorrelation",
    "RadialSpectrum",
    "SobolIndices",
    "StarDiscrepancy",
    "Variation",
    "digital_net_error",
    "discrepancy",
    "dispersion",
    "effective_dimension",
    "extreme_discrepancy",
    "gain_coefficients",
    "hardy_krause_variation",
    "is_net",
    "isotropic_discrepancy",
    "koksma_hlawka_bound",
    "lattice_error",
    "local_discrepancy",
    "minimum_distance",
    "pair_correlation",
    "periodogram",
    "radial_spectrum",
    "smallest_t",
    "sobol_indices",
    "star_discrepancy",
    "star_discrepancy_cost",
    "t_value",
    "triangle_discrepancy",
]
