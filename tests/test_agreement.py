"""Settings that must not change the answer: other kernels, heuristics and samplers agree within their errors.

Every film has its own seed, so that two films are independent estimates of the same image.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
import pytest
from scipy import stats

import evenlight
from evenlight import _core

REPLICATES = 16
BLOCK = 8


def render_box(scenes: Path, seed: int, **settings: Any) -> evenlight.Film:
    """The box in 64 x 64 pixels."""
    return evenlight.render(
        scenes / "box.xml", spp=2 * REPLICATES, replicates=REPLICATES, size=(64, 64), seed=seed, **settings
    )


def block_means(film: evenlight.Film) -> np.ndarray:
    """Means over blocks of pixels, which are nearly normal: (R, blocks, 3)."""
    count, height, width, channels = film.replicates.shape
    blocks = film.replicates.reshape(count, height // BLOCK, BLOCK, width // BLOCK, BLOCK, channels)
    return np.asarray(blocks.mean(axis=(2, 4), dtype=np.float64).reshape(count, -1, channels))


def agree(one: np.ndarray, two: np.ndarray) -> None:
    """Hold two sets of independent replicates to each other, in standard errors."""
    # the whole image: 5 standard errors
    totals = one.mean(axis=1), two.mean(axis=1)
    difference = totals[0].mean(axis=0) - totals[1].mean(axis=0)
    error = np.sqrt(sum(total.var(axis=0, ddof=1) / len(total) for total in totals))
    assert (np.abs(difference) <= 5 * error).all(), (difference, error)
    # blocks: 95 % intervals in 95 % of cases, give or take 5 standard errors of that count
    errors = np.sqrt((one.var(axis=0, ddof=1) + two.var(axis=0, ddof=1)) / REPLICATES)
    outside = np.abs(one.mean(axis=0) - two.mean(axis=0)) > stats.t.ppf(0.975, 2 * REPLICATES - 2) * errors
    assert outside[:, 1].mean() <= 0.05 + 5 * np.sqrt(0.05 * 0.95 / len(outside)), outside.mean()


@pytest.fixture(scope="module")
def usual() -> np.ndarray:
    """The box with default settings."""
    return block_means(render_box(Path(__file__).resolve().parent.parent / "scenes", seed=100))


@pytest.mark.parametrize("kernel", _core.kernels())
def test_kernels_agree(scenes: Path, usual: np.ndarray, kernel: str) -> None:
    film = render_box(scenes, seed=1, kernel=kernel)
    assert film.metadata["kernel"] == ("wide" if kernel == "auto" else kernel)
    agree(block_means(film), usual)


def test_kernels_find_the_same_surfaces(scenes: Path) -> None:
    wide, embree = (render_box(scenes, seed=2, kernel=kernel) for kernel in ("wide", "embree"))
    for name in ("albedo", "normal", "depth"):
        differs = ~np.isclose(getattr(wide, name), getattr(embree, name), rtol=1e-4, atol=1e-4)
        assert differs.mean() < 0.002, name  # edges may fall either way
    agree(block_means(wide), block_means(embree))


@pytest.mark.parametrize("mis", _core.heuristics())
def test_heuristics_agree(scenes: Path, usual: np.ndarray, mis: str) -> None:
    agree(block_means(render_box(scenes, seed=3, mis=mis)), usual)


@pytest.mark.parametrize("sampler", _core.samplers())
def test_samplers_agree(scenes: Path, usual: np.ndarray, sampler: str) -> None:
    agree(block_means(render_box(scenes, seed=4, sampler=sampler)), usual)


@pytest.mark.parametrize("integrator", _core.integrators())
def test_integrators_agree(scenes: Path, usual: np.ndarray, integrator: str) -> None:
    agree(block_means(render_box(scenes, seed=5, integrator=integrator)), usual)


def test_a_wrong_image_does_not_agree(scenes: Path, usual: np.ndarray) -> None:
    with pytest.raises(AssertionError):
        agree(block_means(render_box(scenes, seed=6, max_depth=4)), usual)


def test_one_replicate_has_no_error_but_the_same_kind_of_image(scenes: Path) -> None:
    film = evenlight.render(scenes / "box.xml", spp=8, replicates=1, size=(16, 16))
    assert np.isfinite(film.color).all()
    assert np.isnan(film.standard_error).all()
    assert np.isnan(film.relative_error)


def test_longer_paths_bring_more_light(scenes: Path) -> None:
    means = [float(render_box(scenes, seed=7, max_depth=depth).color.mean()) for depth in (0, 1, 2, 4)]
    assert means[0] == 0
    assert means == sorted(means)


def test_an_exr_reads_back_as_the_film_with_its_settings(scenes: Path, tmp_path: Path) -> None:
    settings: dict[str, Any] = {"spp": 8, "replicates": 2, "seed": 12345, "size": (20, 10), "filter": "tent"}
    settings |= {"integrator": "path", "sampler": "halton", "max_depth": 3, "mis": "balance", "threads": 2}
    film = evenlight.render(evenlight.load_scene(scenes / "box.xml", max_depth=9), **settings)
    film.write(tmp_path / "a.exr")
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        channels = {name: channel.pixels for name, channel in file.channels().items()}
        header = dict(file.header())
    for index, name in enumerate("RGB"):
        np.testing.assert_array_equal(channels[name], film.color[..., index])
        np.testing.assert_array_equal(channels[f"standard_error.{name}"], film.standard_error[..., index])
        np.testing.assert_array_equal(channels[f"albedo.{name}"], film.albedo[..., index])
        np.testing.assert_array_equal(channels[f"normal.{'XYZ'[index]}"], film.normal[..., index])
    np.testing.assert_array_equal(channels["depth.Z"], film.depth)
    about = {name: header[f"evenlight:{name}"] for name in film.metadata}
    for name, value in settings.items():
        expected = list(value) if isinstance(value, tuple) else value
        assert about[name] == (expected if isinstance(expected, str) else json.dumps(expected)), name
    assert about["version"] == evenlight.__version__
    assert about["scene"].endswith("box.xml")
    assert json.loads(about["parameters"]) == {"max_depth": "9"}
    assert about["partial"] == "false"
