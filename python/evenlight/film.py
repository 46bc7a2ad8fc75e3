"""Films: what a render leaves, every pixel with its standard error."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenlight import _core, files, intervals
from evenlight.intervals import Interval

__all__ = ["Film", "Interval", "check_output"]

Image: TypeAlias = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Film:
    """An image estimated by independent replicates, and what else was seen on the way.

    Attributes
    ----------
    replicates : ndarray of float32, shape (R, H, W, 3)
        Linear RGB radiance of each replicate: the same point set under R independent randomizations. Row 0 is the
        top of the image. Where a partial render did not finish a replicate of a pixel, NaN.
    color : ndarray of float32, shape (H, W, 3)
        The mean over replicates.
    standard_error : ndarray of float32, shape (H, W, 3)
        The standard error of `color`, from the spread of the replicates; NaN when there is just one.
    albedo : ndarray of float32, shape (H, W, 3)
        Mean reflectance of the first surface seen, in [0, 1].
    normal : ndarray of float32, shape (H, W, 3)
        Mean shading normal of the first surface seen, in world space.
    depth : ndarray of float32, shape (H, W)
        Mean distance to the first surface seen, in scene units.
    metadata : dict
        All settings, the seed, the version, the samples taken and the seconds they took.
    partial : bool
        Whether the render was interrupted.

    Notes
    -----
    The points of one replicate are *not* independent: they are spread evenly on purpose, so that the textbook formula
    `sqrt(variance of the samples / n)` is wrong for them, mostly far too large, and can be too small. The R replicate
    means, in contrast, are independent and identically distributed and unbiased, whatever the point set; their
    spread is the honest error [1]_. With R replicates, `(color - truth) / standard_error` follows nearly
    a Student t distribution with R - 1 degrees of freedom, so that 8 replicates need 2.36 standard errors for 95 %:
    `confidence_interval`.

    References
    ----------
    .. [1] A. B. Owen, "Monte Carlo theory, methods and examples", chapter 17 (randomized quasi-Monte Carlo).

    Examples
    --------
    >>> import evenlight
    >>> film = evenlight.render("scenes/sky.xml", spp=16, replicates=4, size=(8, 8))
    >>> film.replicates.shape
    (4, 8, 8, 3)
    """

    replicates: Image
    albedo: Image
    normal: Image
    depth: Image
    metadata: dict[str, Any] = field(default_factory=dict)
    partial: bool = False
    color: Image = field(init=False, repr=False)
    standard_error: Image = field(init=False, repr=False)

    def __post_init__(self) -> None:
        color, standard_error = _summarize(self.replicates, skip_missing=self.partial)
        object.__setattr__(self, "color", color)
        object.__setattr__(self, "standard_error", standard_error)

    @property
    def relative_error(self) -> float:
        """Mean of `standard_error` over mean of `color`: one number for the whole image (NaN for one replicate)."""
        with np.errstate(invalid="ignore", divide="ignore"):
            finite = np.isfinite(self.standard_error) & np.isfinite(self.color)
            total = self.color[finite].sum(dtype=np.float64)
            return float(self.standard_error[finite].sum(dtype=np.float64) / total) if total > 0 else float("nan")

    def confidence_interval(self, level: float = 0.95) -> Interval[Image]:
        """Bounds that hold the true color of a pixel and channel in about `level` of the cases.

        Parameters
        ----------
        level : float
            The share of intervals to hold the truth, above 0 and below 1.

        Returns
        -------
        Interval
            `low` and `high`, both of float32 and shape (H, W, 3); NaN where fewer than two replicates are complete.

        Raises
        ------
        ValueError
            If `level` is not between 0 and 1.

        Notes
        -----
        Few samples of a pixel are skewed, since bright paths are rare, and the symmetric interval of Student's t is
        then too short at its upper end. The skewness of the replicates is taken out by a monotone cubic
        transformation of the t statistic [1]_; where they are not skewed, it changes nothing. Few replicates say
        little of their own skewness (eight cannot even show more than 2.3), so it is estimated from the 3 x 3
        pixels around each, as the sum of their third cumulants over the sum of their variances to the power 3/2.

        References
        ----------
        .. [1] P. Hall, "On the removal of skewness by transformation", J. R. Stat. Soc. B 54(1), 221-228 (1992).

        Examples
        --------
        >>> import evenlight
        >>> film = evenlight.render("scenes/sky.xml", spp=16, replicates=4, size=(8, 8))
        >>> low, high = film.confidence_interval(0.95)
        >>> bool(((low <= film.color) & (film.color <= high)).all())
        True
        """
        intervals.check_level(level)
        count = np.isfinite(self.replicates).sum(axis=0) if self.partial else np.array(len(self.replicates))
        if not (count > 1).any():
            missing = np.full_like(self.color, np.nan)
            return Interval(missing, missing.copy())
        quantile = intervals.student_quantile(level, np.maximum(count - 1, 1))
        skewness = _skewness(self.replicates, count, self.partial) / np.sqrt(count)
        low, high = intervals.bounds(self.color, self.standard_error.astype(np.float64), quantile, skewness)
        return Interval(low.astype(np.float32), high.astype(np.float32))

    def write(self, path: str | os.PathLike[str], exposure: float = 0.0) -> None:
        """Write the film to a file, whole or not at all.

        Parameters
        ----------
        path : path
            Its suffix chooses the format: `.exr` (all layers and the metadata, 32-bit), `.png` (8-bit sRGB
            preview of `color`) or `.npz` (all arrays, replicates included, and the metadata as JSON).
        exposure : float
            Stops (factors of two) by which a PNG is brightened; the other formats keep the numbers.

        Raises
        ------
        ValueError
            If the suffix is unknown.
        OSError
            If the file cannot be written; an old file is then kept.
        """
        _writer(path)(self, path, exposure)


def check_output(path: str | os.PathLike[str]) -> None:
    """Raise now what `Film.write` would raise after the work: an unknown suffix or an unwritable place."""
    _writer(path)
    files.check_writable(path)


def _summarize(replicates: Image, skip_missing: bool) -> tuple[Image, Image]:
    """Mean over replicates and its standard error; double precision inside.

    Only in a partial film does NaN mean "not finished": elsewhere a NaN is a fault that must stay visible.
    """
    missing = np.isnan(replicates) if skip_missing else np.zeros(1, dtype=bool)
    count = replicates.shape[0] - missing.sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(missing, 0.0, replicates).sum(axis=0, dtype=np.float64) / count
        squares = np.where(missing, 0.0, (replicates - mean) ** 2).sum(axis=0)
        standard_error = np.sqrt(squares / (count - 1) / count)
    standard_error = np.where(count > 1, standard_error, np.nan)
    return mean.astype(np.float32), standard_error.astype(np.float32)


def _skewness(replicates: Image, count: NDArray[np.int64], skip_missing: bool) -> NDArray[np.float64]:
    """Skewness of the `count` replicates of each pixel, from it and its neighbors; 0 where all replicates are alike.

    The second and third cumulants are unbiased (k-statistics: Fisher 1930); pixels with too few replicates have none.
    """
    total = np.nansum if skip_missing else np.sum
    with np.errstate(invalid="ignore", divide="ignore"):
        from_mean = replicates - total(replicates, axis=0, dtype=np.float64) / count
        second = total(from_mean**2, axis=0) / (count - 1)
        third = total(from_mean**3, axis=0) * count / ((count - 1) * (count - 2))
        second, third = (np.where(count > 2, moment, 0.0) for moment in (second, third))
        cubes, thirds = _sum_around(second**1.5), _sum_around(third)
        return np.asarray(np.where(cubes > 0, thirds / cubes, 0.0))


def _sum_around(image: NDArray[np.float64]) -> NDArray[np.float64]:
    """The sum over the 3 x 3 pixels around each, those outside of the image left out."""
    height, width, _ = image.shape
    padded = np.pad(image, ((1, 1), (1, 1), (0, 0)))
    shifted = [padded[y : y + height, x : x + width] for y in range(3) for x in range(3)]
    return np.asarray(np.sum(shifted, axis=0))


def _as_text(metadata: dict[str, Any]) -> dict[str, str]:
    return {key: value if isinstance(value, str) else json.dumps(value) for key, value in metadata.items()}


def _write_exr(film: Film, path: str | os.PathLike[str], exposure: float) -> None:
    del exposure
    layers = [
        ("color", ["R", "G", "B"], film.color),
        ("standard_error", ["R", "G", "B"], film.standard_error),
        ("albedo", ["R", "G", "B"], film.albedo),
        ("normal", ["X", "Y", "Z"], film.normal),
        ("depth", ["Z"], film.depth[..., np.newaxis]),
    ]
    layers = [(name, channels, np.ascontiguousarray(image, np.float32)) for name, channels, image in layers]
    _core.write_exr(os.fspath(path), layers, _as_text(film.metadata))


def _write_png(film: Film, path: str | os.PathLike[str], exposure: float) -> None:
    image = np.ascontiguousarray(film.color, np.float32)
    _core.write_png(os.fspath(path), image, exposure, _as_text(film.metadata))


def _write_npz(film: Film, path: str | os.PathLike[str], exposure: float) -> None:
    del exposure
    with files.replacing(path) as file:
        np.savez_compressed(
            file,
            color=film.color,
            standard_error=film.standard_error,
            replicates=film.replicates,
            albedo=film.albedo,
            normal=film.normal,
            depth=film.depth,
            metadata=np.array(json.dumps(film.metadata)),
        )


_WRITERS: dict[str, Callable[[Film, str | os.PathLike[str], float], None]] = {
    ".exr": _write_exr,
    ".npz": _write_npz,
    ".png": _write_png,
}


def _writer(path: str | os.PathLike[str]) -> Callable[[Film, str | os.PathLike[str], float], None]:
    suffix = Path(path).suffix.lower()
    if suffix not in _WRITERS:
        raise ValueError(f"{os.fspath(path)}: unknown image suffix '{suffix}'; known: {', '.join(_WRITERS)}")
    return _WRITERS[suffix]
