"""Blue noise judged by its spectrum: points, masks at every gray, and what a blur leaves of errors on a screen."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from evenlight import blue_noise, points, quality

Array = npt.NDArray[np.float64]

N, SETS = 1024, 4
MAKERS: dict[str, Callable[..., Array]] = {
    "poisson_disk": blue_noise.poisson_disk,
    "sample_elimination": blue_noise.sample_elimination,
    "gaussian": blue_noise.gaussian,
}
# Power below half of the principal frequency, power at the peak, and smallest distance times √n: 1.07 in the densest
# packing. White noise has 1, 1 and 0.02. Measured: 0.098, 1.66, 0.71; 0.082, 2.15, 0.78; 0.0004, 4.6, 0.90.
STANDARD = {"poisson_disk": (0.13, 1.4, 0.66), "sample_elimination": (0.11, 1.7, 0.73), "gaussian": (0.002, 3.5, 0.8)}


def test_every_member_has_its_function() -> None:
    assert [info.name for info in blue_noise.available()] == list(MAKERS) == list(STANDARD)
    for info in blue_noise.available():
        usual = MAKERS[info.name](50, seed=4)
        assert (MAKERS[info.name](50, seed=4, **{info.effort: info.usual}) == usual).all()
        assert info.cite


@pytest.mark.parametrize("name", MAKERS)
def test_points_have_the_spectrum_of_blue_noise(name: str) -> None:
    low, peak, distance = STANDARD[name]
    sets = [MAKERS[name](N, seed=seed) for seed in range(SETS)]
    spectra = [quality.radial_spectrum(x, 96) for x in sets]
    power = np.mean([spectrum.power for spectrum in spectra], axis=0)
    frequency = spectra[0].frequency / np.sqrt(N)  # the principal frequency is near 1
    assert power[frequency < 0.5].mean() < low
    assert power.max() > peak
    assert 0.95 < frequency[power.argmax()] < 1.3
    assert abs(power[frequency > 2].mean() - 1) < 0.1
    # 0 dB is what independent frequencies have; a grid has 13 dB and more
    anisotropy = np.mean([spectrum.anisotropy for spectrum in spectra], axis=0)
    assert np.abs(anisotropy[frequency > 0.8]).max() < 3
    assert min(quality.minimum_distance(x) for x in sets) * np.sqrt(N) > distance


@pytest.mark.parametrize("name", MAKERS)
def test_no_pairs_are_close_and_far_ones_are_independent(name: str) -> None:
    found = [quality.pair_correlation(MAKERS[name](N, seed=seed), 40, most=4 / np.sqrt(N)) for seed in range(SETS)]
    density = np.mean([correlation.density for correlation in found], axis=0)
    distance = found[0].distance * np.sqrt(N)
    assert (density[distance < STANDARD[name][2] - 0.05] == 0).all()
    assert density.max() > 1.3
    assert abs(density[distance > 3].mean() - 1) < 0.02


@pytest.mark.parametrize("name", ["poisson_disk", "sample_elimination"])
def test_every_beginning_is_blue_noise(name: str) -> None:
    sets = [MAKERS[name](1000, seed=seed) for seed in range(SETS)]
    for n in (100, 250, 600):
        spectra = [quality.radial_spectrum(x[:n], int(2 * n**0.5)) for x in sets]
        power = np.mean([spectrum.power for spectrum in spectra], axis=0)
        # between powers of two orders by elimination are less even than whole sets
        assert power[spectra[0].frequency < 0.5 * np.sqrt(n)].mean() < 0.25


def test_three_dimensions_are_blue_in_space() -> None:
    n = 600
    wave = np.array([k for k in np.ndindex(5, 5, 5) if 0 < np.linalg.norm(k) < 0.5 * n ** (1 / 3)])
    for name, make in MAKERS.items():
        sets = [make(n, 3, seed=seed) for seed in range(2)]
        power = np.mean([np.abs(np.exp(-2j * np.pi * x @ wave.T).sum(axis=0)) ** 2 / n for x in sets])
        assert power < {"poisson_disk": 0.25, "sample_elimination": 0.2, "gaussian": 0.01}[name], name
        # the spheres of the densest packing have n^(-1/3) * 1.12 between their centers, independent points 0.008
        assert min(quality.minimum_distance(x) for x in sets) * n ** (1 / 3) > 0.6, name


def test_relaxing_moves_points_apart_and_keeps_their_order() -> None:
    x = points.Independent(2, seed=3).points(0, 400)
    assert (blue_noise.relaxed(x, steps=0) == x).all()
    moved = blue_noise.relaxed(x, steps=30)
    assert quality.minimum_distance(moved) > 10 * quality.minimum_distance(x)
    way = np.abs(moved - x)
    assert np.minimum(way, 1 - way).max() < 3 / np.sqrt(400)


def picture_spectrum(picture: Array) -> tuple[Array, Array]:
    """The mean power of a picture on rings of frequencies; 1 for white noise of its variance."""
    size = len(picture)
    power = np.abs(np.fft.fft2(picture - picture.mean())) ** 2 / (picture.var() * picture.size)
    axis = np.fft.fftfreq(size, 1 / size)
    ring = np.rint(np.hypot(axis[:, None], axis[None, :])).astype(int).ravel()
    mean = np.bincount(ring, power.ravel()) / np.bincount(ring)
    return np.arange(len(mean)) / size, mean


@pytest.mark.parametrize("gray", [0.03, 0.1, 0.25, 0.5, 0.8])
def test_a_mask_is_blue_at_every_gray(gray: float) -> None:
    mask = blue_noise.dither_mask((128, 128), seed=1)
    dots = (mask < gray).astype(np.float64)
    assert abs(dots.mean() - gray) <= 0.5 / mask.size + 1e-12
    frequency, power = picture_spectrum(dots)
    principal = np.sqrt(min(gray, 1 - gray))
    # measured: 0.02 to 0.06 and 0.06 to 0.08, but 0.18 at one half, where pixels touch; white noise has 1
    assert power[1:][frequency[1:] < 0.25 * principal].mean() < 0.09
    assert power[1:][frequency[1:] < 0.5 * principal].mean() < (0.25 if gray == 0.5 else 0.11)
    assert power.max() > 1.3


def test_a_mask_itself_is_blue_and_can_be_any_rectangle() -> None:
    frequency, power = picture_spectrum(blue_noise.dither_mask((128, 128), seed=2))
    assert power[1:][frequency[1:] < 0.1].mean() < 0.02
    for shape in [(1, 1), (1, 7), (5, 3), (48, 20)]:
        mask = blue_noise.dither_mask(shape, seed=3)
        assert (np.sort(mask.ravel()) == (np.arange(mask.size) + 0.5) / mask.size).all()


def test_the_order_of_a_mask_is_a_progressive_sample() -> None:
    mask = blue_noise.dither_mask((128, 128), seed=4)
    order = np.argsort(mask, axis=None)
    for n in (64, 256, 1024):
        x = (np.stack(np.unravel_index(order[:n], mask.shape), axis=-1) + 0.5) / 128
        spectrum = quality.radial_spectrum(x, int(2 * n**0.5))
        assert spectrum.power[spectrum.frequency < 0.5 * np.sqrt(n)].mean() < 0.12
        assert quality.minimum_distance(x) * np.sqrt(n) > 0.6


def test_the_channels_of_a_mask_are_independent_masks() -> None:
    mask = blue_noise.dither_mask((64, 64), 3, exchanges=0, seed=5)
    assert mask.shape == (64, 64, 3)
    for channel in np.moveaxis(mask, -1, 0):
        frequency, power = picture_spectrum(channel)
        assert power[1:][frequency[1:] < 0.1].mean() < 0.02
    correlation = np.corrcoef(mask.reshape(-1, 3).T) - np.eye(3)
    # 4 standard deviations of white noise, of which there are three: less than one in 5000
    assert np.abs(correlation).max() < 4 / 64


def test_exchanged_vectors_are_blue_together() -> None:
    both = [blue_noise.dither_mask((64, 64), 2, exchanges=exchanges, seed=5) for exchanges in (0, 16)]
    rest = []
    for mask in both:
        assert (np.sort(mask.reshape(-1, 2), axis=0) == (np.arange(4096)[:, None] + 0.5) / 4096).all()
        # what depends on both channels together, its parts that depend on one of them taken away
        joint = np.sign(mask[..., 0] - 0.5) * np.sign(mask[..., 1] - 0.5)
        frequency, power = picture_spectrum(joint)
        rest.append(power[1:][frequency[1:] < 0.1].mean())
        # each channel alone loses some of its blue: measured 0.0002 and 0.025, where white noise has 1
        frequency, power = picture_spectrum(mask[..., 0])
        assert power[1:][frequency[1:] < 0.1].mean() < 0.05
    assert rest[1] < 0.5 * rest[0]  # measured: 0.25
    assert (blue_noise.dither_mask((64, 64), 2, exchanges=16, seed=5, workers=2) == both[1]).all()


def blurred(error: Array, sigma: float) -> Array:
    """A periodic Gaussian blur."""
    weight = np.exp(-2 * (np.pi * sigma * np.fft.fftfreq(len(error))) ** 2)
    return np.fft.ifft2(np.fft.fft2(error) * weight[:, None] * weight[None, :]).real


@pytest.mark.parametrize("curve", ["hilbert", "morton"])
@pytest.mark.parametrize("spp", [1, 4])
def test_errors_on_the_screen_are_blue(curve: str, spp: int) -> None:
    side = 128
    places = blue_noise.pixel_places((side, side), curve=curve, seed=6)
    x = points.Sobol(2, scramble="owen", seed=6).points(0, side * side * spp)
    value = np.exp(-4 * ((x - 0.4) ** 2).sum(axis=1)) + (x[:, 0] + 0.5 * x[:, 1] > 0.8)
    error = value.reshape(-1, spp).mean(axis=1)[places] - value.mean()
    # the same errors in other places: the mean square is the same to the last digit
    white = np.random.default_rng(6).permutation(error.ravel()).reshape(error.shape)
    blue_rest, white_rest = (np.mean(blurred(picture, 2.0) ** 2) for picture in (error, white))
    # white noise keeps 1/(4 π σ²) = 2 % of its variance
    assert abs(white_rest / np.mean(white**2) * 16 * np.pi - 1) < 0.3
    # measured: 0.27 to 0.36
    assert blue_rest < 0.45 * white_rest
    frequency, power = picture_spectrum(error)
    assert power[1:][frequency[1:] < 0.06].mean() < 0.3
    assert power[frequency > 0.4].mean() > 1.05


def test_places_of_a_part_are_those_of_the_whole_and_plain_curves_are_known() -> None:
    whole = blue_noise.pixel_places((64, 64), seed=1)
    assert (blue_noise.pixel_places((40, 64), seed=1) == whole[:40]).all()
    assert (np.sort(whole, axis=None) == np.arange(64 * 64)).all()
    morton = blue_noise.pixel_places((4, 4), curve="morton", shuffle=False)
    assert morton.tolist() == [[0, 1, 4, 5], [2, 3, 6, 7], [8, 9, 12, 13], [10, 11, 14, 15]]


def test_seeds_and_threads() -> None:
    for make in MAKERS.values():
        assert (make(100, seed=1) == make(100, seed=1)).all()
        assert (make(100, seed=1) != make(100, seed=2)).any()
    assert (blue_noise.gaussian(3000, steps=3, workers=2) == blue_noise.gaussian(3000, steps=3)).all()
    assert (blue_noise.dither_mask((9, 9)) == blue_noise.dither_mask((9, 9), seed=0)).all()


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: blue_noise.gaussian(-1), "n must be at least 0"),
        (lambda: blue_noise.poisson_disk(10, 9), "1 to 8 dimensions, not 9"),
        (lambda: blue_noise.sample_elimination(10, candidates=0), "candidates must be at least 1"),
        (lambda: blue_noise.poisson_disk(2**40), "points times darts must be at most"),
        (lambda: blue_noise.relaxed([[0.5, 1.0]]), r"\[0, 1\), not at 1"),
        (lambda: blue_noise.relaxed([0.5]), "x must have shape"),
        (lambda: blue_noise.dither_mask((0, 4)), "rows must be at least 1"),
        (lambda: blue_noise.dither_mask((10**4, 10**4)), "16777216 pixels"),
        (lambda: blue_noise.dither_mask((8, 8), 9), "channels must be from 1 to 8, not 9"),
        (lambda: blue_noise.pixel_places((4, 4), curve="peano"), "unknown curve 'peano'"),
        (lambda: blue_noise.pixel_places((1, 10**6)), "sides from 1 to 65536"),
    ],
)
def test_mistakes_are_named(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
