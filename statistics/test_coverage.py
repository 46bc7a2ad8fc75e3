"""Intervals that say 95 % hold the truth in 95 % of cases: measured on a scene whose truth is known exactly."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import evenlight
from evenlight import _core

SCENE = Path(__file__).resolve().parent.parent / "scenes" / "sphere_light.xml"
SIZE = 32
SEEDS = 12


def truth() -> np.ndarray:
    """L rho r^2 h / (h^2 + x^2 + z^2)^(3/2), averaged over each pixel: see the scene's comment."""
    fine = 16
    at = (np.arange(SIZE * fine) + 0.5) * 4 / (SIZE * fine) - 2
    x, z = np.meshgrid(at, at)
    image = 0.5 * 10 * 0.25 * 2 / (4 + x * x + z * z) ** 1.5
    return np.asarray(image.reshape(SIZE, fine, SIZE, fine).mean(axis=(1, 3)))


@pytest.mark.parametrize("sampler", _core.samplers())
def test_intervals_cover_what_they_say(sampler: str) -> None:
    """12,288 intervals: the count's own standard error is 0.2 %, the rest of the band is for skewed errors."""
    scene = evenlight.load_scene(SCENE)
    wanted = truth()
    covered = []
    for seed in range(SEEDS):
        film = evenlight.render(scene, sampler=sampler, spp=64, replicates=8, seed=seed)
        low, high = film.confidence_interval(0.95)
        covered.append((low[..., 0] <= wanted) & (wanted <= high[..., 0]))
    assert 0.93 <= np.mean(covered) <= 0.97


@pytest.mark.parametrize("sampler", _core.samplers())
def test_the_stated_error_is_the_actual_error(sampler: str) -> None:
    """The mean of squared standard errors is an unbiased estimate of the mean squared error."""
    scene = evenlight.load_scene(SCENE)
    wanted = truth()
    films = [evenlight.render(scene, sampler=sampler, spp=128, replicates=8, seed=seed) for seed in range(SEEDS)]
    actual = np.mean([(film.color[..., 0].astype(np.float64) - wanted) ** 2 for film in films])
    stated = np.mean([film.standard_error[..., 0].astype(np.float64) ** 2 for film in films])
    assert 0.9 < stated / actual < 1.1
