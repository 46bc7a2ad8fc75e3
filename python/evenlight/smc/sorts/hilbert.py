"""Along Hilbert's curve through the cloud of states: the default of filters (Gerber and Chopin 2015).

Coordinates are standardized and squeezed into the unit cube, so that no particle far away makes all others one cell.
States of one dimension come in ascending order.
"""

from __future__ import annotations

from .sort import Sort, along_curve

__all__ = ["SORT"]

SORT = Sort(along_curve, lambda d: 1)
