"""Rendering: exact answers in standard errors, the same bits on any number of threads, and refusals."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

import evenlight
from evenlight import _core

REPLICATES = 16  # Student's t with 15 degrees of freedom has few surprises


def expected_furnace(film: evenlight.Film) -> NDArray[np.float64]:
    """E (1 - rho^8) / (1 - rho)."""
    return np.broadcast_to(1.9921875 * np.array([0.5, 0.25, 0.125]), film.color.shape)


def expected_sky(film: evenlight.Film) -> NDArray[np.float64]:
    """L above the horizon, rho L below."""
    image = np.empty(film.color.shape)
    half = film.color.shape[0] // 2
    image[:half] = [1.0, 0.8, 0.5]
    image[half:] = [0.5, 0.4, 0.25]
    return image


def expected_sphere_light(film: evenlight.Film) -> NDArray[np.float64]:
    """L rho r^2 h / (h^2 + x^2 + z^2)^(3/2), averaged over each pixel."""
    fine, side = 8, film.color.shape[0]
    at = (np.arange(side * fine) + 0.5) * 4 / (side * fine) - 2
    x, z = np.meshgrid(at, at)
    image = 0.5 * 10 * 0.25 * 2 / (4 + x * x + z * z) ** 1.5
    image = image.reshape(side, fine, side, fine).mean(axis=(1, 3))
    return np.repeat(image[..., np.newaxis], 3, axis=2)


ANSWERS = {"furnace": expected_furnace, "sky": expected_sky, "sphere_light": expected_sphere_light}


@pytest.mark.parametrize("scene", ANSWERS)
@pytest.mark.parametrize("sampler", _core.samplers())
@pytest.mark.parametrize("mis", ["power", "balance"])
def test_exact_answers(scenes: Path, scene: str, sampler: str, mis: str) -> None:
    film = evenlight.render(
        scenes / f"{scene}.xml", sampler=sampler, mis=mis, spp=16 * REPLICATES, replicates=REPLICATES, size=(16, 16)
    )
    judge(film, ANSWERS[scene](film))


def judge(film: evenlight.Film, expected: NDArray[np.float64]) -> None:
    """Hold a film to its exact answer, in its own standard errors.

    Replicates of all pixels are independent samples of the image mean, so the mean over the image has an honest
    error too, much smaller than that of a pixel: 5 of those must suffice, with 1e-5 relative for rounding.
    """
    means = film.replicates.mean(axis=(1, 2), dtype=np.float64)
    error = means.std(axis=0, ddof=1) / np.sqrt(len(means))
    wanted = expected.mean(axis=(0, 1))
    assert (np.abs(means.mean(axis=0) - wanted) <= 5 * error + 1e-5 * wanted).all(), (means.mean(axis=0), wanted)
    # Pixels: 95 % intervals must hold the truth in 95 % of cases, give or take 5 standard errors of that count. (A few
    # replicates of few, well-spread points are far from normal, so that the tail says little about single pixels.)
    noisy = film.standard_error[..., 0] > 1e-5 * expected[..., 0]
    outside = np.abs(film.color - expected)[..., 0] > stats.t.ppf(0.975, REPLICATES - 1) * film.standard_error[..., 0]
    pixels = max(1, int(np.count_nonzero(noisy)))
    assert outside[noisy].sum() / pixels <= 0.05 + 5 * np.sqrt(0.05 * 0.95 / pixels)
    np.testing.assert_allclose(film.color[~noisy], expected[~noisy], rtol=1e-4)


@pytest.mark.parametrize("sampler", _core.samplers())
def test_threads_do_not_change_a_bit(scenes: Path, sampler: str) -> None:
    scene = evenlight.load_scene(scenes / "demo.xml")
    settings: dict[str, Any] = {"sampler": sampler, "spp": 4, "replicates": 2, "size": (50, 34), "seed": 11}
    one, three = (evenlight.render(scene, threads=threads, **settings) for threads in (1, 3))
    for name in ("replicates", "albedo", "normal", "depth"):
        np.testing.assert_array_equal(getattr(one, name), getattr(three, name))


def test_seeds_and_replicates_differ(scenes: Path) -> None:
    first, second = (evenlight.render(scenes / "demo.xml", spp=8, size=(24, 16), seed=seed) for seed in (0, 1))
    assert first.replicates.shape == (4, 16, 24, 3)
    assert not np.array_equal(first.color, second.color)
    assert not np.array_equal(first.replicates[0], first.replicates[1])


def test_sobol_beats_independent_points(scenes: Path) -> None:
    scene = evenlight.load_scene(scenes / "sphere_light.xml")
    errors = {
        sampler: float(np.mean((film.color - expected_sphere_light(film)) ** 2))
        for sampler in ("independent", "sobol")
        for film in [evenlight.render(scene, sampler=sampler, spp=64, replicates=4, size=(16, 16))]
    }
    assert errors["sobol"] < errors["independent"] / 4, errors


@pytest.mark.parametrize("name", ["sphere_light", "sky"])
def test_errors_of_zsobol_are_as_large_as_those_of_sobol_but_cancel(scenes: Path, name: str) -> None:
    scene = evenlight.load_scene(scenes / f"{name}.xml")
    alone, after_blur = {}, {}
    weight = np.exp(-2 * (np.pi * 1.5 * np.fft.fftfreq(64)) ** 2)
    for sampler in ("sobol", "zsobol"):
        film = evenlight.render(scene, sampler=sampler, spp=64, replicates=16, size=(64, 64), seed=9)
        # replicates are independent: what they differ by is their error, without any reference
        error = film.replicates[..., 1].astype(np.float64) - film.color[..., 1]
        sigma = np.sqrt(error.var(axis=0))
        scaled = error / np.where(sigma > 1e-6, sigma, np.inf)
        rest = np.fft.ifft2(np.fft.fft2(scaled) * weight[:, None] * weight).real
        alone[sampler], after_blur[sampler] = np.median(sigma), np.mean(rest**2)
    assert abs(alone["zsobol"] / alone["sobol"] - 1) < 0.2, alone
    # measured: a quarter to a third
    assert after_blur["zsobol"] < 0.45 * after_blur["sobol"], after_blur


def test_features_are_what_the_camera_sees(scenes: Path) -> None:
    film = evenlight.render(scenes / "sphere_light.xml", spp=4, size=(8, 8))
    np.testing.assert_allclose(film.depth, 1.0, atol=0.0101)  # rays may begin at the near clip plane
    np.testing.assert_allclose(film.albedo, 0.5, rtol=1e-5)
    np.testing.assert_allclose(film.normal, np.broadcast_to([0, 1, 0], (8, 8, 3)), atol=1e-5)


def test_depth_counts_as_mitsuba_counts(scenes: Path) -> None:
    for depth, expected in [(1, 1.0), (2, 1.5), (3, 1.75)]:
        film = evenlight.render(scenes / "furnace.xml", max_depth=depth, spp=64, replicates=8, size=(8, 8))
        error = film.standard_error.max() + 1e-6
        np.testing.assert_allclose(film.color[..., 0], 0.5 * expected, atol=8 * error)


def test_progress_reaches_its_total(scenes: Path) -> None:
    states: list[dict[str, Any]] = []
    evenlight.render(scenes / "demo.xml", spp=8, size=(96, 64), progress=lambda state: states.append(dict(state)))
    assert states
    done = [state["done"] for state in states]
    assert done == sorted(done)
    assert done[-1] == states[-1]["total"] == 8 * 96 * 64
    assert states[-1]["relative_error"] is None or states[-1]["relative_error"] > 0


def test_an_exception_in_progress_stops_the_run_unchanged(scenes: Path) -> None:
    def fail(state: dict[str, Any]) -> None:
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        evenlight.render(scenes / "demo.xml", spp=64, size=(96, 64), progress=fail)


def test_metadata_make_the_image_again(scenes: Path) -> None:
    film = evenlight.render(scenes / "sky.xml", spp=8, replicates=2, size=(6, 4), seed=9, filter="box", max_depth=3)
    about = film.metadata
    assert about["samples"] == 8 * 6 * 4
    assert about["seconds"] > 0
    assert about["version"] == evenlight.__version__
    names = ("integrator", "sampler", "spp", "replicates", "seed", "max_depth", "filter", "mis")
    again = evenlight.render(about["scene"], size=(6, 4), **{name: about[name] for name in names})
    np.testing.assert_array_equal(film.replicates, again.replicates)


def test_parameters_are_written_as_a_scene_file_writes_them(scenes: Path) -> None:
    scene = evenlight.load_scene(scenes / "furnace.xml", reflectance=0, radiance="1 2 3", max_depth=2)
    film = evenlight.render(scene, spp=4, size=(4, 4))
    np.testing.assert_allclose(film.color, np.broadcast_to([1, 2, 3], (4, 4, 3)), rtol=1e-6)


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"integrator": "magic"}, "magic"),
        ({"sampler": "dice"}, "sobol"),
        ({"spp": 10, "replicates": 4}, "replicates"),
        ({"spp": 0}, "spp"),
        ({"replicates": 0}, "replicates"),
        ({"threads": 0}, "threads"),
        ({"max_depth": -2}, "max_depth"),
        ({"filter": "sieve"}, "sieve"),
        ({"size": (0, 4)}, "size"),
        ({"size": (1 << 20, 1 << 20)}, "size"),
        ({"mis": "luck"}, "luck"),
        ({"kernel": "corn"}, "corn"),
    ],
)
def test_refusals_name_the_culprit(scenes: Path, settings: dict[str, Any], message: str) -> None:
    small: dict[str, Any] = {"size": (4, 4), "spp": 4}
    with pytest.raises(ValueError, match=message):
        evenlight.render(scenes / "sky.xml", **(small | settings))


def test_a_loaded_scene_keeps_its_kernel(scenes: Path) -> None:
    scene = evenlight.load_scene(scenes / "sky.xml", kernel="wide")
    with pytest.raises(ValueError, match="load_scene"):
        evenlight.render(scene, kernel="embree")


def test_unknown_plugins_are_errors_with_their_line_or_warnings(tmp_path: Path, scenes: Path) -> None:
    text = (scenes / "sky.xml").read_text().replace('<bsdf type="diffuse">', '<bsdf type="velvetine">')
    path = tmp_path / "scene.xml"
    path.write_text(text)
    line = 1 + text[: text.index("velvetine")].count("\n")
    with pytest.raises(ValueError, match=rf"scene\.xml:{line}: .*velvetine.*diffuse"):
        evenlight.load_scene(path)
    (warning,) = evenlight.load_scene(path, lenient=True).warnings[:1]
    assert "velvetine" in warning
