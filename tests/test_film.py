"""Films: means and standard errors from replicates, and files that bring the same numbers back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import OpenEXR
import pytest
from scipy import stats

from evenlight.film import Film, check_output


def make_film(replicates: int | npt.NDArray[np.float32] = 4, **changes: Any) -> Film:
    generator = np.random.default_rng(5)
    if isinstance(replicates, int):
        replicates = generator.random((replicates, 6, 7, 3), dtype=np.float32)
    layers: dict[str, Any] = {
        "replicates": replicates,
        "albedo": generator.random((6, 7, 3), dtype=np.float32),
        "normal": generator.random((6, 7, 3), dtype=np.float32) - np.float32(0.5),
        "depth": generator.random((6, 7), dtype=np.float32),
        "metadata": {"seed": 3, "scene": "Küche.xml", "size": [7, 6], "max_depth": None},
    }
    return Film(**(layers | changes))


def test_standard_error_is_that_of_the_mean_of_replicates() -> None:
    film = make_film()
    np.testing.assert_allclose(film.color, film.replicates.mean(axis=0), rtol=1e-6)
    np.testing.assert_allclose(film.standard_error, film.replicates.std(axis=0, ddof=1) / 2, rtol=1e-5)
    assert film.relative_error == pytest.approx(film.standard_error.mean() / film.color.mean(), rel=1e-5)


def test_one_replicate_has_no_standard_error() -> None:
    film = make_film(replicates=1)
    np.testing.assert_array_equal(film.color, film.replicates[0])
    assert np.isnan(film.standard_error).all()
    assert np.isnan(film.relative_error)


def skewness_around(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Third over second k-statistic to the power 3/2, both summed over a pixel and its neighbors."""
    skewness = np.empty(values.shape[1:])
    for y, x, channel in np.ndindex(skewness.shape):
        near = values[:, max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2, channel].reshape(8, -1).T
        cubes = sum(stats.kstat(pixel, 2) ** 1.5 for pixel in near)
        skewness[y, x, channel] = sum(stats.kstat(pixel, 3) for pixel in near) / cubes
    return skewness


@pytest.mark.parametrize("level", [0.5, 0.95, 0.999])
def test_intervals_solve_the_equation_they_are_defined_by(level: float) -> None:
    film = make_film(replicates=8)
    values = film.replicates.astype(np.float64)
    skewness = skewness_around(values) / np.sqrt(8)
    quantile = stats.t.ppf(0.5 + level / 2, df=7)
    for end, wanted in zip(film.confidence_interval(level), (quantile, -quantile), strict=True):
        t = (values.mean(axis=0) - end) / (values.std(axis=0, ddof=1) / np.sqrt(8))
        found = t + skewness * (t**2 / 3 + 1 / 6) + skewness**2 * t**3 / 27
        np.testing.assert_allclose(found, wanted, rtol=1e-4)


def test_intervals_of_replicates_that_are_not_skewed_are_those_of_student() -> None:
    half = make_film(replicates=4).replicates
    film = make_film(replicates=np.concatenate([half, 1 - half]))
    low, high = film.confidence_interval(0.9)
    student = stats.t.ppf(0.95, df=7) * film.standard_error
    np.testing.assert_allclose(high - film.color, student, rtol=1e-3)
    np.testing.assert_allclose(film.color - low, student, rtol=1e-3)


def test_intervals_of_skewed_replicates_cover_better_than_student() -> None:
    """Means of 8 squares of normal numbers: 6,000 intervals, whose rate has a standard error of 0.3 %."""
    generator = np.random.default_rng(11)
    replicates = (generator.standard_normal((8, 40, 50, 3, 8)) ** 2).mean(axis=-1).astype(np.float32)
    film = make_film(replicates=replicates)
    low, high = film.confidence_interval(0.95)
    covered = np.mean((low <= 1) & (high >= 1))
    plain = np.mean(np.abs(film.color - 1) <= stats.t.ppf(0.975, df=7) * film.standard_error)
    assert plain < covered
    assert 0.93 < covered < 0.97


def test_intervals_need_two_replicates_and_a_level() -> None:
    assert np.isnan(make_film(replicates=1).confidence_interval()).all()
    replicates = make_film().replicates.copy()
    replicates[1:, 0, 0] = np.nan
    low, high = make_film(replicates=replicates, partial=True).confidence_interval()
    assert np.isnan([low[0, 0], high[0, 0]]).all()
    assert np.isfinite(low[1]).all()
    for level in (0.0, 1.0, 95.0, float("nan")):
        with pytest.raises(ValueError, match="level must be between 0 and 1"):
            make_film().confidence_interval(level)


def test_only_a_partial_film_passes_over_missing_replicates() -> None:
    replicates = make_film().replicates.copy()
    replicates[2:, 0, 0] = np.nan
    replicates[1:, 1, 1] = np.nan
    whole = make_film(replicates=4)
    partial = Film(replicates, whole.albedo, whole.normal, whole.depth, {}, partial=True)
    np.testing.assert_allclose(partial.color[0, 0], replicates[:2, 0, 0].mean(axis=0), rtol=1e-6)
    np.testing.assert_allclose(
        partial.standard_error[0, 0], replicates[:2, 0, 0].std(axis=0, ddof=1) / np.sqrt(2), rtol=1e-5
    )
    np.testing.assert_array_equal(partial.color[1, 1], replicates[0, 1, 1])
    assert np.isnan(partial.standard_error[1, 1]).all()
    faulty = Film(replicates, whole.albedo, whole.normal, whole.depth, {})
    assert np.isnan(faulty.color[0, 0]).all(), "a NaN in a finished film is a fault and must show"


def test_exr_opens_in_openexr_with_all_layers_and_metadata(tmp_path: Path) -> None:
    film = make_film()
    film.write(tmp_path / "a.exr")
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        assert len(file.parts) == 1
        channels = {name: channel.pixels for name, channel in file.channels().items()}
        header = dict(file.header())
    expected = {"depth.Z": film.depth}
    for index, name in enumerate("RGB"):
        expected[name] = film.color[..., index]
        expected[f"standard_error.{name}"] = film.standard_error[..., index]
        expected[f"albedo.{name}"] = film.albedo[..., index]
        expected[f"normal.{'XYZ'[index]}"] = film.normal[..., index]
    assert set(channels) == set(expected)
    for name, pixels in expected.items():
        assert channels[name].dtype == np.float32
        np.testing.assert_array_equal(channels[name], pixels, err_msg=name)
    assert header["compression"] == OpenEXR.ZIP_COMPRESSION
    assert header["evenlight:layers"].split() == ["color", "standard_error", "albedo", "normal", "depth"]
    written = {key: header[f"evenlight:{key}"] for key in film.metadata}
    assert written == {"seed": "3", "scene": "Küche.xml", "size": "[7, 6]", "max_depth": "null"}


def test_npz_brings_everything_back(tmp_path: Path) -> None:
    film = make_film()
    film.write(tmp_path / "a.npz")
    with np.load(tmp_path / "a.npz") as archive:
        for name in ("color", "standard_error", "replicates", "albedo", "normal", "depth"):
            np.testing.assert_array_equal(archive[name], getattr(film, name))
        assert json.loads(str(archive["metadata"])) == film.metadata


def test_png_is_a_png(tmp_path: Path) -> None:
    make_film().write(tmp_path / "a.PNG", exposure=-1.5)
    assert (tmp_path / "a.PNG").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")


def test_bad_outputs_are_errors(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"unknown image suffix '.jpg'; known: .exr, .npz, .png"):
        check_output(tmp_path / "a.jpg")
    with pytest.raises(OSError, match="missing"):
        check_output(tmp_path / "missing" / "a.exr")
    with pytest.raises(ValueError, match="exposure"):
        make_film().write(tmp_path / "a.png", exposure=float("nan"))
    assert not list(tmp_path.iterdir())
