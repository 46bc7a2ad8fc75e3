"""The comparison behind `make validate`, on images whose truth is known."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benches import validate
from benches.blocks import block_means, compare, pool

SHAPE = (108, 192, 3)


def images(shift: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Eight replicates and a reference of the same gradient, both noisy; `shift` is relative."""
    generator = np.random.default_rng(8)
    truth = np.broadcast_to(np.linspace(0.1, 2.0, SHAPE[1])[:, np.newaxis], SHAPE)
    replicates = truth * (1 + shift) + generator.normal(0, 0.2, (8, *SHAPE)) * truth
    return replicates, truth + generator.normal(0, 0.05, SHAPE) * truth, 0.05 * truth


def test_block_means_leave_out_incomplete_blocks() -> None:
    image = np.arange(17 * 8 * 2, dtype=float).reshape(17, 8, 2)
    means = block_means(image)
    assert means.shape == (2, 1, 2)
    np.testing.assert_allclose(means[1, 0, 1], image[8:16, :, 1].mean())


def test_equal_images_agree() -> None:
    found = compare(*images())
    assert found.beyond < 0.006  # Student's t with 7 degrees of freedom: 0.0052, less what the reference adds
    assert abs(found.difference) < 4 * found.difference_error
    assert found.difference_error < 0.001
    assert found.deviations.shape == (13, 24, 3)


def test_a_shift_of_the_mean_is_found() -> None:
    found = compare(*images(shift=0.02))
    assert found.difference == pytest.approx(0.02, abs=4 * found.difference_error)
    assert not validate.Verdict("x", found, yardstick=1.0).passed


def test_a_wrong_object_is_found_and_nan_is_not_overlooked() -> None:
    replicates, reference, error = images()
    replicates[:, 40:72, 40:72] *= 1.4
    found = compare(replicates, reference, error)
    assert found.beyond > 0.03
    assert not validate.Verdict("x", found, yardstick=0.02).passed
    replicates[0, 0, 0, 0] = np.nan
    assert not validate.Verdict("x", compare(replicates, reference, error), yardstick=1.0).passed


def test_pooling_averages_but_keeps_the_reference_error() -> None:
    first, second = compare(*images()), compare(*images(shift=0.02))
    pooled = pool([first, second])
    assert pooled.beyond == (first.beyond + second.beyond) / 2
    assert pooled.difference == (first.difference + second.difference) / 2
    assert min(first.difference_error, second.difference_error) <= pooled.difference_error


def test_every_calibrated_scene_is_in_the_table() -> None:
    assert len(validate.yardsticks()) == 10
    assert validate.yardsticks()["cornell-box"] == 0.0017


def test_the_report_tells_failures_and_absences() -> None:
    found = compare(*images())
    verdicts = [validate.Verdict("a", found, found.beyond, 0.01), validate.Verdict("b", message="no volumes")]
    options = argparse.Namespace(spp=64, replicates=8, seeds=4)
    text = validate.to_markdown(verdicts, {"date": "today"}, options)
    assert "| a |" in text
    assert "passed" in text
    assert "not rendered: no volumes" in text
