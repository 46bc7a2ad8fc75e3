"""Multilevel methods measured: errors over tolerances and processor time against QMCPy, and how costs grow."""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benches.machine import describe
from evenlight.multilevel import mlmc, mlqmc
from evenlight.multilevel.models import GeometricBrownianMotion

ASIAN = 5.76309  # Vecer's equation, to 5e-5
EUROPEAN = 10.4505835722
RUNS = 100
Run = Callable[[int], float]


def against_qmcpy(tolerances: Iterable[float] = (0.02, 0.01, 0.005)) -> Iterator[str]:
    """Root mean squared error and processor time on the arithmetic Asian call, and the time for equal errors."""
    yield "## Time for equal errors"
    yield ""
    yield (
        "The arithmetic Asian call: errors over tolerances with their standard errors, and processor time of a run. "
        "*Equal error* is time * (error / tolerance)^p, what an error of the tolerance would have taken: p = 2 "
        "for independent points, 1.5 for others. *Times ours* is that of a class over that of our function with such "
        f"points. {RUNS} runs, a quarter of them at 0.005."
    )
    yield ""
    yield from (
        "| method | tolerance | RMSE / tolerance | ms | equal error, ms | times ours |",
        "|---|---|---|---|---|---|",
    )
    for rmse in tolerances:
        own: dict[float, tuple[float, float]] = {}
        for name, (power, run) in (_ours(rmse) | _qmcpy(rmse)).items():
            ratio, doubt, spent = _measured(run, rmse, RUNS if rmse > 0.005 else RUNS // 4)
            equal = spent * ratio**power
            first, first_doubt = own.setdefault(power, (equal, doubt))
            times = f"{equal / first:.1f} ± {power * np.hypot(doubt, first_doubt):.0%}" if first != equal else "1"
            yield f"| {name} | {rmse:g} | {ratio:.2f} ± {doubt:.0%} | {spent:.1f} | {equal:.1f} | {times} |"


def _measured(run: Run, rmse: float, runs: int) -> tuple[float, float, float]:
    """Root mean squared error over the tolerance, its relative standard error, milliseconds of a run."""
    run(-1)  # what is computed once, such as matrices of principal components, is not counted
    started = time.process_time()
    squares = np.array([(run(seed) - ASIAN) ** 2 for seed in range(runs)])
    spent = 1e3 * (time.process_time() - started) / runs
    doubt = 0.5 * float(np.std(squares, ddof=1) / np.sqrt(runs) / squares.mean())
    return float(np.sqrt(squares.mean())) / rmse, doubt, spent


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


def costs(tolerances: Iterable[float] = (0.2, 0.1, 0.05, 0.02, 0.01), runs: int = 10) -> Iterator[str]:
    """Cost in time steps times the squared tolerance: constant for Milstein, a squared logarithm for Euler."""
    yield "## How costs grow"
    yield ""
    yield f"`mlmc` on the European call, cost in time steps; {runs} runs."
    yield ""
    yield from ("| scheme | tolerance | RMSE / tolerance | cost * tolerance^2 |", "|---|---|---|---|")
    for scheme in ("milstein", "euler"):
        for rmse in tolerances:
            found = [mlmc(GeometricBrownianMotion("european", scheme), rmse=rmse, seed=seed) for seed in range(runs)]
            ratio = np.sqrt(np.mean([(estimate.value - EUROPEAN) ** 2 for estimate in found])) / rmse
            cost = np.mean([estimate.cost for estimate in found]) * rmse**2
            yield f"| {scheme} | {rmse:g} | {ratio:.2f} | {cost:.0f} |"


def evenly_spread(tolerances: Iterable[float] = (1e-2, 2e-3, 1e-3, 1e-4)) -> Iterator[str]:
    """Cost of both drivers on the Asian option; that of independent points at the last tolerances is extrapolated."""
    yield "## What evenly spread points save"
    yield ""
    yield (
        "The Asian call with exact steps, one run; `mlqmc` with principal components. Costs of `mlmc` in brackets "
        "follow from the last one measured, as tolerance^-2."
    )
    yield ""
    yield from ("| tolerance | mlmc | mlqmc | ratio |", "|---|---|---|---|")
    product = 0.0
    for rmse in tolerances:
        run = rmse >= 2e-3
        if run:
            product = mlmc(GeometricBrownianMotion("asian", "exact"), rmse=rmse, seed=1).cost * rmse**2
        smooth = GeometricBrownianMotion("asian", "exact", construction="pca", first_steps=2)
        even = mlqmc(smooth, rmse=rmse, seed=1).cost
        cost = product / rmse**2
        yield f"| {rmse:g} | {f'{cost:.2g}' if run else f'({cost:.2g})'} | {even:.2g} | {cost / even:.0f} |"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and write the tables."""
    parser = argparse.ArgumentParser(prog="benches.multilevel", description=__doc__)
    parser.add_argument("--report", type=Path, default=Path(__file__).with_name("MULTILEVEL.md"))
    options = parser.parse_args(arguments)
    machine = "; ".join(f"{key}: {value}" for key, value in describe().items())
    lines = [
        "# Multilevel methods measured",
        "",
        "Written by `make bench-multilevel`; figures of one run on one machine.",
        "",
        machine,
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for section in (against_qmcpy, costs, evenly_spread):
            lines.append("")
            for line in section():
                print(line, flush=True)
                lines.append(line)
    options.report.write_text("\n".join(lines) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
