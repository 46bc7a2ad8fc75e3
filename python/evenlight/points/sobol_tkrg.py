"""Sobol' points for up to 50,000 dimensions, and for neighbors among them."""

from .engine import Engine

__all__ = ["SobolTkrg"]


class SobolTkrg(Engine):
    """Sobol' points with the direction numbers tkrg-a-ap5, up to 50,000 dimensions and 64 digits deep.

    Choose it for more dimensions than `Sobol` has, or where neighboring coordinates act together, as the steps of a
    path do: any five successive coordinates of the first 2^10 rows are one in each of the 4^5 cells of side 1/4, which
    those of `Sobol` mostly are not. Pairs of coordinates are as even as there, on average.

    Parameters
    ----------
    d : int
        1 to 50,000.
    scramble : {"owen", "owen_exact", "linear", "linear_striped", "linear_i_binomial", "digital_shift", "shift", "none"}
        As for `Sobol`; all but "shift" keep every balance.
    seed, rng : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default. Two names, for SciPy's sake.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Warns
    -----
    UserWarning
        Once, if the first call of `random` asks for a number of rows that is not a power of 2.

    Notes
    -----
    As fast as `Sobol`; measured, setting up 50,000 dimensions takes 0.8 seconds.

    Reference: A. Oliva Denis, J. Wheeldon, I. Manyakin and A. Papaioannou, *Sobol direction numbers for quasi-Monte
    Carlo simulation*, SSRN 7040539 (2026).

    Examples
    --------
    >>> from evenlight.points import SobolTkrg
    >>> x = SobolTkrg(30_000, seed=7).points(0, 1024)
    >>> cells = (4 * x[:, 20_000:20_005]).astype(int) @ [256, 64, 16, 4, 1]
    >>> len(set(cells))
    1024
    """

    sequence = "sobol_tkrg"
