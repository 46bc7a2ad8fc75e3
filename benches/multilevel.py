"""Multilevel methods measured: errors over tolerances and processor time against QMCPy, and how costs grow."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from evenlight.multilevel import mlmc, mlqmc
from evenlight.multilevel.models import GeometricBrownianMotion

ASIAN = 5.76309  # Vecer's equation, to 5e-5
EUROPEAN = 10.4505835722
Run = Callable[[int], float]


def against_qmcpy(tolerances: Iterable[float] = (0.02, 0.01, 0.005), runs: int = 20) -> None:
    """Root mean squared error and processor time on the arithmetic Asian call, and the time for equal errors.

    The last column is time * (error / tolerance)^p, what an error as large as the tolerance would have taken: p = 2 for
    independent points, 1.5 for others.
    """
    print("| method | tolerance | RMSE / tolerance | ms | ms at equal error |\n|---|---|---|---|---|")
    for rmse in tolerances:
        for name, (power, run) in (_ours(rmse) | _qmcpy(rmse)).items():
            run(-1)  # what is computed once, such as matrices of principal components, is not counted
            started = time.process_time()
            errors = np.array([run(seed) for seed in range(runs)]) - ASIAN
            spent = 1e3 * (time.process_time() - started) / runs
            ratio = float(np.sqrt(np.mean(errors**2))) / rmse
            print(f"| {name} | {rmse:g} | {ratio:.2f} | {spent:.1f} | {spent * ratio**power:.1f} |", flush=True)


def _ours(rmse: float) -> dict[str, tuple[float, Run]]:
    plain = GeometricBrownianMotion("asian", "exact", first_steps=2)
    smooth = GeometricBrownianMotion("asian", "exact", construction="pca", first_steps=2)
    return {
        "evenlight mlmc": (2.0, lambda seed: mlmc(plain, rmse=rmse, seed=abs(seed)).value),
        "evenlight mlqmc": (1.5, lambda seed: mlqmc(smooth, rmse=rmse, seed=abs(seed)).value),
    }


def _qmcpy(rmse: float) -> dict[str, tuple[float, Run]]:
    """The classes of QMCPy, where it is installed."""
    try:
        import qmcpy
    except ImportError:
        return {}

    def rule(criterion: Any, points: Any, **settings: Any) -> Run:
        def run(seed: int) -> float:
            option = qmcpy.FinancialOption(
                points(seed=abs(seed), **settings),
                option="ASIAN",
                volatility=0.2,
                start_price=100,
                strike_price=100,
                interest_rate=0.05,
            )
            value, _ = criterion(option, rmse_tol=rmse, levels_max=20).integrate()
            return float(np.squeeze(value))

        return run

    return {
        "QMCPy CubMLMC": (2.0, rule(qmcpy.CubMLMC, qmcpy.IIDStdUniform)),
        "QMCPy CubMLMCCont": (2.0, rule(qmcpy.CubMLMCCont, qmcpy.IIDStdUniform)),
        "QMCPy CubMLQMC": (1.5, rule(qmcpy.CubMLQMC, qmcpy.DigitalNetB2, replications=32)),
        "QMCPy CubMLQMCCont": (1.5, rule(qmcpy.CubMLQMCCont, qmcpy.DigitalNetB2, replications=32)),
    }


def costs(tolerances: Iterable[float] = (0.2, 0.1, 0.05, 0.02, 0.01), runs: int = 10) -> None:
    """Cost in time steps times the squared tolerance: constant for Milstein, a squared logarithm for Euler."""
    print("| scheme | tolerance | RMSE / tolerance | cost * tolerance^2 |\n|---|---|---|---|")
    for scheme in ("milstein", "euler"):
        for rmse in tolerances:
            found = [mlmc(GeometricBrownianMotion("european", scheme), rmse=rmse, seed=seed) for seed in range(runs)]
            ratio = np.sqrt(np.mean([(estimate.value - EUROPEAN) ** 2 for estimate in found])) / rmse
            cost = np.mean([estimate.cost for estimate in found]) * rmse**2
            print(f"| {scheme} | {rmse:g} | {ratio:.2f} | {cost:.0f} |", flush=True)


def evenly_spread(tolerances: Iterable[float] = (1e-2, 1e-3, 1e-4)) -> None:
    """Cost of both drivers on the Asian option; that of independent points at the last tolerance is extrapolated."""
    print("| tolerance | mlmc | mlqmc | ratio |\n|---|---|---|---|")
    cost = 0.0
    for rmse in tolerances:
        if rmse >= 5e-3:
            cost = mlmc(GeometricBrownianMotion("asian", "exact"), rmse=rmse, seed=1).cost * rmse**2
        smooth = GeometricBrownianMotion("asian", "exact", construction="pca", first_steps=2)
        even = mlqmc(smooth, rmse=rmse, seed=1).cost
        print(f"| {rmse:g} | {cost / rmse**2:.2g} | {even:.2g} | {cost / rmse**2 / even:.0f} |", flush=True)


def main() -> None:
    """Print all tables."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        against_qmcpy()
        costs()
        evenly_spread()


if __name__ == "__main__":
    main()
