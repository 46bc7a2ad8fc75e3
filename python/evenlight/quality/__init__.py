"""How even points are: figures of merit, one file each."""

from .t_value import t_value

__all__ = ["t_value"]
