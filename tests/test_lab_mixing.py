"""Lessons of mixing: exact hitting times and mixing times, exponents, modes that are missed and found."""

from __future__ import annotations

import numpy as np
import pytest

from evenlight import lab


@pytest.mark.parametrize("n", [1, 4, 10, 20])
def test_crossing_takes_the_square(n: int) -> None:
    assert lab.crossing_time(n) == pytest.approx(n * n, rel=1e-12)


def test_mixing_times_are_the_published_ones() -> None:
    """Up to one step: where a law exactly at 1/4 counts is a convention."""
    sizes = (16, 32, 64, 128, 256)
    lazy, lifted = ([lab.mixing_steps(n, lifted=kind) for n in sizes] for kind in (False, True))
    assert (np.abs(np.subtract(lazy, [24, 97, 389, 1554, 6217])) <= 1).all()
    assert (np.abs(np.subtract(lifted, [18, 40, 85, 173, 351])) <= 1).all()


@pytest.mark.parametrize("name", lab.LESSONS)
def test_lessons_hold(name: str) -> None:
    lesson = lab.mixing_lesson(name)
    assert lesson.holds
    assert (np.diff(lesson.costs) > 0).all()


def test_a_lesson_can_fail() -> None:
    lesson = lab.mixing_lesson("lifted", sizes=[4, 6])
    assert lesson._replace(exponent=2.0).holds is False
    with pytest.raises(ValueError, match="unknown lesson 'flight'; known: crossing"):
        lab.mixing_lesson("flight")
    with pytest.raises(ValueError, match="at least 2 sizes"):
        lab.mixing_lesson("walk", sizes=[16])
    with pytest.raises(ValueError, match="n must be even"):
        lab.mixing_steps(15)


def test_far_modes_are_missed_without_a_sign_and_found_by_tempering() -> None:
    lesson = lab.far_modes(seed=3)
    assert lesson.holds
    assert lesson.alone.standard_error == 0
    near = lab.far_modes(distance=4.0, n=200, chains=4, seed=3)
    assert not near.holds  # a walk that crosses is no failure
    with pytest.raises(ValueError, match="distance must be at least 4"):
        lab.far_modes(distance=1.0)
