"""Statistics of bounces, and roulette with given probabilities: exact series, the predicted second moment, refusals."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import evenlight

LUMINANCE = np.array([0.212671, 0.715160, 0.072169])


def test_a_furnace_is_a_geometric_series(scenes: Path) -> None:
    depth, replicates = 8, 16
    runs = [
        evenlight.bounce_statistics(scenes / "furnace.xml", 16, seed, depth, size=(8, 8)) for seed in range(replicates)
    ]
    means = np.array([run.mean for run in runs])
    emitted = LUMINANCE @ [0.5, 0.25, 0.125]
    total = means.sum(axis=1)
    # 5 standard errors of 15 degrees of freedom: a false alarm in 6000 seeds, each of two
    error = total.std(ddof=1) / np.sqrt(replicates)
    assert abs(total.mean() - emitted * 1.9921875) < 5 * error + 1e-6
    # all but the ends, where lights are seen directly or not sampled any more
    excess = means[:, 2:-1] - 0.5 * means[:, 1:-2]
    assert (np.abs(excess.mean(axis=0)) < 5 * excess.std(axis=0, ddof=1) / np.sqrt(replicates) + 1e-6).all()
    for run in runs:
        assert (run.alive == 1).all()  # a closed room
        assert run.rays[-1] == 1  # no light is sampled beyond the last segment
        assert ((run.rays[:-1] > 1) & (run.rays[:-1] <= 2)).all()
        assert run.tail_mean_square[-1] == run.mean_square[-1]


def test_images_are_the_contributions_of_a_render(scenes: Path) -> None:
    scene = evenlight.load_scene(scenes / "box.xml")
    size = (24, 16)
    measured = evenlight.bounce_statistics(scene, 8, 3, 5, size=size, images=True)
    film = evenlight.render(scene, spp=8, replicates=1, seed=3, max_depth=5, size=size, roulette="none")
    assert measured.images is not None
    np.testing.assert_allclose(measured.images.sum(axis=0), film.color, rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose((measured.images @ LUMINANCE).mean(axis=(1, 2)), measured.mean, rtol=1e-5)


def test_the_second_moment_under_roulette_is_as_predicted(scenes: Path) -> None:
    scene = evenlight.load_scene(scenes / "furnace.xml", reflectance=0.8)
    survival, depth, size, count = [0.9, 0.6, 0.5], 6, (32, 32), 64
    settings: dict[str, Any] = {"sampler": "independent", "max_depth": depth, "size": size, "filter": "box"}
    measured = [
        evenlight.bounce_statistics(scene, 64, seed, depth, sampler="independent", size=size, filter="box")
        for seed in range(1, 9)
    ]
    reach = np.cumprod([1.0, *survival, 0.5, 0.5])
    moments = np.array([np.sum(-np.diff(run.tail_mean_square, append=0) / reach) for run in measured])
    film = evenlight.render(scene, spp=count, replicates=count, roulette=survival, **settings)
    sampled = np.mean((film.replicates @ LUMINANCE) ** 2, axis=(1, 2))  # one sample per pixel and replicate
    error = np.hypot(moments.std(ddof=1) / np.sqrt(len(moments)), sampled.std(ddof=1) / np.sqrt(count))
    # 5 standard errors, small enough to see a forgotten factor; false alarm below 1e-4
    assert error < 0.01 * moments.mean()
    assert abs(moments.mean() - sampled.mean()) < 5 * error
    # and the mean is that without roulette
    plain = evenlight.render(scene, spp=count, replicates=count, seed=1, roulette="none", **settings)
    means = [(film.replicates @ LUMINANCE).mean(axis=(1, 2)), (plain.replicates @ LUMINANCE).mean(axis=(1, 2))]
    error = np.sqrt(sum(mean.var(ddof=1) / count for mean in means))
    assert abs(means[0].mean() - means[1].mean()) < 5 * error


def test_threads_do_not_change_a_bit(scenes: Path) -> None:
    one, three = (
        evenlight.bounce_statistics(scenes / "demo.xml", 4, 5, 4, size=(40, 34), threads=threads, images=True)
        for threads in (1, 3)
    )
    for field in fields(one):
        np.testing.assert_array_equal(getattr(one, field.name), getattr(three, field.name))


@pytest.mark.parametrize(
    ("roulette", "words"),
    [
        ("luck", "throughput, none, or a list"),
        ([], "at least one"),
        ([0.5, 0.0], "not 0"),
        ([1.5], "not 1.5"),
        ([float("nan")], "not NaN"),
    ],
)
def test_bad_roulette_is_refused(scenes: Path, roulette: Any, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        evenlight.render(scenes / "sky.xml", spp=4, size=(4, 4), roulette=roulette)


def test_endless_paths_are_refused(scenes: Path) -> None:
    for roulette in ("none", [0.5, 1.0]):
        with pytest.raises(ValueError, match="max_depth must be limited"):
            evenlight.render(scenes / "sky.xml", spp=4, size=(4, 4), max_depth=-1, roulette=roulette)
    for depth in (-1, 0, 1025):
        with pytest.raises(ValueError, match="max_depth must be 1 to 1024"):
            evenlight.bounce_statistics(scenes / "sky.xml", 4, size=(4, 4), max_depth=depth)
    with pytest.raises(TypeError, match="roulette must be a name or survival probabilities"):
        evenlight.render(scenes / "sky.xml", spp=4, size=(4, 4), roulette=3.0)  # type: ignore[arg-type]
