"""Estimators measured: tolerances against QMCPy, optimal weights of a thousand components, adaptive mixtures."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

import evenlight
from evenlight import integrands
from evenlight.importance import Normal, adaptive_estimate, optimal_mixture
from evenlight.importance.mixture import Mixture
from evenlight.lab import singularity
from evenlight.points import Independent, Sobol

RUNS = 40


def tolerances() -> None:
    """Function values, processor time and share of runs within the tolerance, for Keister's integral."""
    print("| rule | dims | tolerance | values | ms | within |\n|---|---|---|---|---|---|")
    for dims, atol in ((3, 1e-3), (5, 1e-3)):
        f = integrands.build("keister", dims)
        for name, run in {"evenlight": _ours(f, atol), **_qmcpy(dims, atol)}.items():
            started = time.process_time()
            found = [run(seed) for seed in range(RUNS)]
            spent = 1e3 * (time.process_time() - started) / RUNS
            within = np.mean([abs(value - f.exact) <= atol for value, _ in found])
            print(f"| {name} | {dims} | {atol:g} | {np.mean([n for _, n in found]):.0f} | {spent:.0f} | {within:.3f} |")


def _ours(f: integrands.Problem, atol: float) -> Callable[[int], tuple[float, int]]:
    def run(seed: int) -> tuple[float, int]:
        estimate = evenlight.integrate(f, Sobol(f.d, seed=seed), atol=atol)
        return estimate.value, estimate.n

    return run


def _qmcpy(dims: int, atol: float) -> dict[str, Callable[[int], tuple[float, int]]]:
    """The rules of QMCPy, where it is installed."""
    try:
        import qmcpy
    except ImportError:
        return {}

    def rule(criterion: Any, **settings: Any) -> Callable[[int], tuple[float, int]]:
        def run(seed: int) -> tuple[float, int]:
            points = qmcpy.DigitalNetB2(dims, seed=seed, **settings)
            value, data = criterion(qmcpy.Keister(points), abs_tol=atol).integrate()
            return float(np.squeeze(value)), int(data.n_total)

        return run

    return {
        "QMCPy CubQMCNetG": rule(qmcpy.CubQMCNetG),
        "QMCPy CubQMCRepStudentT": rule(qmcpy.CubQMCRepStudentT, replications=16),
    }


def weights() -> None:
    """Processor seconds to a relative duality gap of 1e-6."""
    print("| rows | components | seconds | gap |\n|---|---|---|---|")
    for n, components in ((10_000, 100), (10_000, 1000), (100_000, 1000)):
        sample = _pilot(n, components)
        started = time.process_time()
        found = optimal_mixture(*sample, control_variates=False, gap=1e-6)
        print(f"| {n} | {components} | {time.process_time() - started:.2f} | {found.gap:.1e} |")


def _pilot(n: int, components: int) -> tuple[Any, Any, Any]:
    """The singular integrand, with normals of all widths, one in twenty near the singularity."""
    generator = np.random.default_rng(0)
    problem = singularity()
    near = np.arange(components - 1) % 20 == 0
    centers = np.where(near[:, np.newaxis], 1 + 0.3 * generator.normal(size=(components - 1, 5)), 0.0)
    centers = np.where(near[:, np.newaxis], centers, 2 * generator.normal(size=(components - 1, 5)))
    widths = 2.0 ** -np.where(near, generator.uniform(0, 6, components - 1), generator.uniform(-1, 4, components - 1))
    normals = [Normal(center, width) for center, width in zip(centers, widths, strict=True)]
    mixture = Mixture(problem.target, [*normals, problem.target])
    component = np.repeat(np.arange(components), n // components)
    sample = mixture.at(component, Independent(5).points(0, n))
    return problem.f(sample.x) * sample.target, sample.q, sample.q.mean(axis=1)


def adaptive() -> None:
    """Relative error and processor seconds on the singular integrand with 10⁵ values in all."""
    problem = singularity()
    started = time.process_time()
    runs = [
        adaptive_estimate(problem.f, problem.target, problem.proposals, n=100_000, seed=seed) for seed in range(RUNS)
    ]
    spent = (time.process_time() - started) / RUNS
    error = np.sqrt(np.mean([(run.value / problem.exact - 1) ** 2 for run in runs]))
    print(f"adaptive mixture: relative error {error:.1e}, {spent:.2f} s (pypmc 1.2.6: 4.4e-4, 4.9 s)")


if __name__ == "__main__":
    tolerances()
    weights()
    adaptive()
