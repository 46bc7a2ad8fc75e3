"""Evenly spread points on levels: errors against tolerances; EVENLIGHT_RUNS=400 is four times the runs."""

from __future__ import annotations

import math
import os
import warnings

import numpy as np
import pytest

from evenlight.multilevel import MultilevelWarning, mlqmc
from evenlight.multilevel.models import GeometricBrownianMotion
from option_prices import PRICES

RUNS = int(os.environ.get("EVENLIGHT_RUNS", "100"))


@pytest.mark.parametrize(
    ("payoff", "scheme", "construction", "rmse"),
    [
        ("european", "euler", "bridge", 0.2),
        ("european", "euler", "bridge", 0.05),
        ("european", "milstein", "bridge", 0.05),
        ("european", "milstein", "bridge", 0.01),
        ("asian", "milstein", "bridge", 0.02),
        ("asian", "exact", "pca", 0.05),
        ("asian", "exact", "pca", 0.01),
        ("lookback", "milstein", "bridge", 0.2),
        ("lookback", "milstein", "bridge", 0.05),
        ("barrier", "milstein", "bridge", 0.2),
        ("barrier", "milstein", "bridge", 0.05),
        ("digital", "milstein", "bridge", 0.1),
    ],
)
def test_errors_are_as_promised(payoff: str, scheme: str, construction: str, rmse: float) -> None:
    """Error over tolerance between 0.5 and 1.05, give or take 3 standard errors of 7 % each: wrong once in 700 runs."""
    model = GeometricBrownianMotion(payoff, scheme, construction=construction)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MultilevelWarning)
        found = [mlqmc(model, rmse=rmse, seed=seed) for seed in range(RUNS)]
    errors = np.array([estimate.value - PRICES[payoff] for estimate in found])
    cost = np.mean([estimate.cost for estimate in found])
    ratio, slack = math.sqrt(np.mean(errors**2)) / rmse, 3 / math.sqrt(2 * RUNS)
    print(f"{payoff} {scheme} {rmse}: RMSE / tolerance {ratio:.2f}, cost x tolerance squared {cost * rmse**2:.3g}")
    assert 0.5 * (1 - slack) < ratio < 1.05 * (1 + slack)
