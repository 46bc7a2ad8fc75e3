"""Blue noise on the screen: dither masks, and places of pixels in one sequence."""

from typing import SupportsIndex

import numpy as np
import numpy.typing as npt

from evenlight import _core
from evenlight.arguments import WORD, SeedLike, integer, seed_number, threads

__all__ = ["dither_mask", "pixel_places"]


def dither_mask(
    shape: tuple[SupportsIndex, SupportsIndex],
    channels: SupportsIndex | None = None,
    *,
    exchanges: SupportsIndex = 16,
    seed: SeedLike = None,
    workers: SupportsIndex = 1,
) -> npt.NDArray[np.float64]:
    """Make a dither mask by void and cluster: whatever the threshold, the pixels below it are blue noise.

    Parameters
    ----------
    shape : (int, int)
        Rows and columns, at least one each and at most 2^24 pixels. The mask can be repeated in both directions.
    channels : int, optional
        The number of values of each pixel, 1 to 8, each of which is a mask; without it there is no last axis.
    exchanges : int, default 16
        How many times for each pixel its vector may be exchanged with that of another one, where neighbors then differ
        more in all channels together: for what depends on all of them at once. With 0 the channels are masks of their
        own, which is best for what depends on them one by one. For one channel it means nothing.
    seed : int or numpy.random.Generator, optional
        The same number always gives the same bits; 0 by default.

    workers : int, default 1
        The most threads to use, one for each channel; -1 for all processors. The mask does not depend on it.

    Returns
    -------
    array of float64, shape (rows, columns) or (rows, columns, channels)
        Each channel has the values (r + 1/2) / pixels, r = 0, 1, ..., once each. In the order of its values, the
        pixels of a channel of its own are progressive samples of the plane.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    128 x 128 pixels take 0.03 seconds, 512 x 512 take 3; 16 exchanges for each of 64 x 64 pixels take one.

    References: R. Ulichney, *The void-and-cluster method for dither array generation*, Proc. SPIE 1913, 332-343 (1993);
    I. Georgiev and M. Fajardo, *Blue-noise dithered sampling*, SIGGRAPH Talks (2016).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import blue_noise
    >>> mask = blue_noise.dither_mask((64, 64), seed=1)
    >>> gray = np.full((64, 64), 0.3)
    >>> float((mask < gray).mean())
    0.300048828125
    """
    count = 1 if channels is None else integer("channels", channels, 1, 8)
    tries = min(integer("exchanges", exchanges, 0, WORD), 2**32 - 1)
    planes = _core.dither_planes((*_sides(shape), count), tries, seed_number(seed), threads(workers))
    return planes[0] if channels is None else np.ascontiguousarray(np.moveaxis(planes, 0, -1))


def pixel_places(
    shape: tuple[SupportsIndex, SupportsIndex],
    *,
    curve: str = "hilbert",
    shuffle: bool = True,
    seed: SeedLike = None,
) -> npt.NDArray[np.uint64]:
    """Number the pixels of an image so that neighbors share a net: their errors cancel when the eye averages them.

    Pixel p of the order takes the points ``p * spp`` to ``(p + 1) * spp - 1`` of one sequence for the whole image. The
    error of each pixel is as large as with points of its own, but what is left of it after a blur is much less.

    Parameters
    ----------
    shape : (int, int)
        Rows and columns, 1 to 65,536.
    curve : {"hilbert", "morton", "gray"}, default "hilbert"
        The order of the pixels before the shuffle.
    shuffle : bool, default True
        Whether the four quarters of the square, and again of each quarter, change places at random. Without it the
        curve is seen in the errors.
    seed : int or numpy.random.Generator, optional
        For the shuffle; a shuffle of its own for every pair of dimensions makes these independent. 0 by default.

    Returns
    -------
    array of uint64, shape (rows, columns)
        Different places below 4^k, for an image in a square of side 2^k.

    Raises
    ------
    TypeError, ValueError
        If an argument is not as above.

    Notes
    -----
    0.2 microseconds per pixel.

    References: A. Ahmed and P. Wonka, *Screen-space blue-noise diffusion of Monte Carlo sampling error via hierarchical
    ordering of pixels*, ACM Trans. Graph. 39(6), 244 (2020).

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight import blue_noise, points
    >>> places = blue_noise.pixel_places((32, 32), seed=1)
    >>> x = points.Sobol(2, scramble="owen", seed=1).points(0, 4 * 1024).reshape(1024, 4, 2)[places]
    >>> x.shape
    (32, 32, 4, 2)
    >>> error = (x**2).sum(axis=-1).mean(axis=-1) - 2 / 3
    >>> blocks = error.reshape(8, 4, 8, 4).mean(axis=(1, 3))  # 16 pixels are 64 points of a net
    >>> bool(np.std(blocks) < 0.1 * np.std(error))
    True
    """
    rows, columns = _sides(shape)
    return _core.pixel_places(curve, (rows, columns), seed_number(seed) if shuffle else None)


def _sides(shape: tuple[SupportsIndex, SupportsIndex]) -> tuple[int, int]:
    rows, columns = shape
    return integer("rows", rows, 1, WORD), integer("columns", columns, 1, WORD)
