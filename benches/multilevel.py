"""Multilevel methods measured: an Asian option to a tolerance, against QMCPy's classes in the same run.

Errors are root mean squares over runs; work is squared error times processor time: what a run of equal error costs.
"""

from __future__ import annotations

import os
import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from evenlight.multilevel import mlmc, mlqmc
from evenlight.multilevel.models import GeometricBrownianMotion

PRICE = 5.76309  # ± 0.00005, of the default terms: Večeř's partial differential equation
RUNS = int(os.environ.get("EVENLIGHT_RUNS", "12"))
TOLERANCES = (0.01, 0.005)

Run = Callable[[float, int], float]


def asian_option() -> None:
    """Error over tolerance, processor time, and work relative to the peer's method of the same kind."""
    print("| method | tolerance | error / tolerance | seconds | work | times less work |\n|---|---|---|---|---|---|")
    for peer, ours in (("CubMLMC", _mlmc), ("CubMLMCCont", _mlmc), ("CubMLQMC", _mlqmc), ("CubMLQMCCont", _mlqmc)):
        for tolerance in TOLERANCES:
            theirs = _measured(_qmcpy(peer), tolerance)
            own = _measured(ours, tolerance)
            for name, (error, seconds) in ((f"QMCPy {peer}", theirs), (f"evenlight{ours.__name__}", own)):
                gain = theirs[0] ** 2 * theirs[1] / (error**2 * seconds)
                line = f"{error / tolerance:.2f} | {seconds:.3f} | {error**2 * seconds:.2e} | {gain:.1f}"
                print(f"| {name} | {tolerance} | {line} |", flush=True)


def _measured(run: Run, tolerance: float) -> tuple[float, float]:
    """Root mean squared error, and the median of processor seconds."""
    errors, seconds = [], []
    for seed in range(1, RUNS + 1):
        started = time.process_time()
        value = run(tolerance, seed)
        seconds.append(time.process_time() - started)
        errors.append(value - PRICE)
    return float(np.sqrt(np.mean(np.square(errors)))), float(np.median(seconds))


def _mlmc(tolerance: float, seed: int) -> float:
    model = GeometricBrownianMotion("asian", "exact", first_steps=2)  # QMCPy's first level too has two steps
    return float(mlmc(model, rmse=tolerance, seed=seed).value)


def _mlqmc(tolerance: float, seed: int) -> float:
    model = GeometricBrownianMotion("asian", "exact", first_steps=2, construction="pca")
    return float(mlqmc(model, rmse=tolerance, seed=seed).value)


def _qmcpy(name: str) -> Run:
    import qmcpy

    def run(tolerance: float, seed: int) -> float:
        points: Any = qmcpy.IIDStdUniform(2, seed=seed)
        if "QMC" in name:
            points = qmcpy.DigitalNetB2(2, seed=seed, replications=32)
        terms = {"start_price": 100, "strike_price": 100, "volatility": 0.2, "interest_rate": 0.05}
        option = qmcpy.FinancialOption(points, option="ASIAN", call_put="CALL", **terms)
        return float(np.squeeze(getattr(qmcpy, name)(option, rmse_tol=tolerance).integrate()[0]))

    return run


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        asian_option()
