"""Estimators measured: tolerances against QMCPy, adaptive mixtures against pypmc and vegas, weights of a thousand."""

from __future__ import annotations

import argparse
import json
import sys
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import evenlight
from benches.machine import describe
from evenlight import integrands
from evenlight.domains import Law
from evenlight.importance import Normal, adaptive_estimate, mixture_estimate, optimal_mixture, vegas_estimate
from evenlight.importance.mixture import Mixture
from evenlight.lab import MixtureProblem, singularity
from evenlight.points import Independent, Lattice, Sobol

Record = dict[str, Any]
Found = tuple[float, float, int]  # value, half width of the 95 % interval, function values
Run = Callable[[int], Found]

HERE = Path(__file__).resolve().parent
PROBLEMS = (
    ("keister", 3, 1e-3),
    ("keister", 5, 1e-3),
    ("genz_gaussian", 4, 1e-4),
    ("genz_continuous", 3, 1e-4),
    ("genz_discontinuous", 3, 5e-3),
    ("ball", 3, 5e-3),
    ("asian_option", 8, 1e-2),
)
SIZES = ((10_000, 100), (10_000, 1000), (100_000, 1000))
N = 100_000  # function values of a run on the singular integrand, all stages together


def measure(run: Run, exact: float, runs: int) -> Record:
    """Errors, coverage, function values and processor seconds of a run with seeds from 0 on."""
    started = time.process_time()
    found = np.array([run(seed) for seed in range(runs)])
    seconds = (time.process_time() - started) / runs
    errors = np.abs(found[:, 0] - exact)
    return {
        "runs": runs,
        "rmse": float(np.sqrt(np.mean(errors**2))) / abs(exact),
        "errors": np.sort(errors).tolist(),
        "covered": float(np.mean(errors <= found[:, 1])),
        "values": float(found[:, 2].mean()),
        "seconds": seconds,
    }


def of(estimate: evenlight.Estimate) -> Found:
    """What a run tells, from an estimate."""
    return estimate.value, estimate.half_width(0.95), round(estimate.cost)


def tolerance_rules(f: integrands.Problem, atol: float) -> dict[str, Run]:
    """Rules that work up to an absolute tolerance: ours, and QMCPy's on the very same function of the unit cube."""
    import qmcpy

    def ours(kind: Any, replicates: int) -> Run:
        return lambda seed: of(evenlight.integrate(f, kind(f.d, seed=seed), atol=atol, replicates=replicates))

    def theirs(criterion: Any, points: Any, **settings: Any) -> Run:
        def values(x: Any) -> Any:
            return f(np.asarray(x).reshape(-1, f.d)).reshape(np.shape(x)[:-1])

        def run(seed: int) -> Found:
            uniform = qmcpy.Uniform(points(f.d, seed=seed, **settings))
            value, data = criterion(qmcpy.CustomFun(uniform, values), abs_tol=atol, rel_tol=0).integrate()
            return float(np.squeeze(value)), atol, int(data.n_total)

        return run

    return {
        "Sobol', 16 replicates": ours(Sobol, 16),
        "Sobol', 8": ours(Sobol, 8),
        "lattice, 16": ours(Lattice, 16),
        "QMCPy RepStudentT, 16": theirs(qmcpy.CubQMCRepStudentT, qmcpy.DigitalNetB2, replications=16),
        "QMCPy NetG": theirs(qmcpy.CubQMCNetG, qmcpy.DigitalNetB2),
        "QMCPy LatticeG": theirs(qmcpy.CubQMCLatticeG, qmcpy.Lattice),
    }


def singular_rules(problem: MixtureProblem) -> dict[str, Run]:
    """Ways to the mean of the singular integrand with N function values in all."""
    law = Law(problem.target)
    parts = (problem.f, problem.target, problem.proposals)

    def vegas(combine: Any, beta: float) -> Run:
        return lambda seed: of(vegas_estimate(problem.f, law, n=N, combine=combine, beta=beta, seed=seed))

    return {
        "adaptive mixture": lambda seed: of(adaptive_estimate(*parts, n=N, seed=seed)),
        "mixture, optimal weights": lambda seed: of(mixture_estimate(*parts, n=N * 9 // 10, pilot=N // 10, seed=seed)),
        "vegas, inverse variance": vegas("inverse-variance", 0.0),
        "vegas, equal weights": vegas("equal", 0.0),
        "VEGAS+, inverse variance": vegas("inverse-variance", 0.75),
        "VEGAS+, equal weights": vegas("equal", 0.75),
        "pypmc": lambda seed: _pypmc(problem, seed),
    }


def _pypmc(problem: MixtureProblem, seed: int, pilot: int = 10_000, rounds: int = 4) -> Found:
    """Population Monte Carlo from the same proposals; only points of the last mixture count."""
    import pypmc

    np.random.seed(seed)  # noqa: NPY002  # pypmc has no other
    target = problem.target
    inverse = np.linalg.inv(2.0 ** -np.abs(np.subtract.outer(np.arange(5), np.arange(5))))

    def log_integrand(x: Any) -> float:
        return float(-1.2 * np.log(((x - 1) ** 2).sum()) - 0.5 * x @ inverse @ x)

    start = [pypmc.density.gauss.Gauss(q.mean, q.covariance) for q in problem.proposals if isinstance(q, Normal)]
    sampler = pypmc.sampler.importance_sampling.ImportanceSampler(
        log_integrand, pypmc.density.mixture.MixtureDensity(start)
    )
    for _ in range(rounds):
        latent = sampler.run(pilot, trace_sort=True)
        sampler.proposal = pypmc.mix_adapt.pmc.gaussian_pmc(
            sampler.samples[-1], sampler.proposal, sampler.weights[-1][:, 0], latent, rb=True
        )
    sampler.run(N - pilot * rounds)
    weights = sampler.weights[-1][:, 0] * np.exp(target.logpdf(np.zeros((1, 5)))[0])
    return float(weights.mean()), float(1.96 * weights.std(ddof=1) / np.sqrt(len(weights))), N


def optimize(n: int, components: int) -> Record:
    """Processor seconds to a duality gap of 1e-6: normals of all widths, one in twenty near the singularity."""
    generator = np.random.default_rng(0)
    problem = singularity()
    near = np.arange(components - 1) % 20 == 0
    centers = np.where(near[:, np.newaxis], 1 + 0.3 * generator.normal(size=(components - 1, 5)), 0.0)
    centers = np.where(near[:, np.newaxis], centers, 2 * generator.normal(size=(components - 1, 5)))
    widths = 2.0 ** -np.where(near, generator.uniform(0, 6, components - 1), generator.uniform(-1, 4, components - 1))
    normals = [Normal(center, width) for center, width in zip(centers, widths, strict=True)]
    mixture = Mixture(problem.target, [*normals, problem.target])
    sample = mixture.at(np.repeat(np.arange(components), n // components), Independent(5).points(0, n))
    fp, density = problem.f(sample.x) * sample.target, sample.q.mean(axis=1)
    started = time.process_time()
    found = optimal_mixture(fp, sample.q, density, control_variates=False, gap=1e-6)
    return {"rows": n, "components": components, "seconds": time.process_time() - started, "gap": found.gap}


def to_markdown(record: Record) -> str:
    """The tables of a record."""
    head = "; ".join(f"{name}: {value}" for name, value in record["machine"].items())
    lines = ["# Estimators", "", "Written by `make bench-estimators`; figures of one run on one machine. Ratios count."]
    lines += ["", head, "", *_tolerances(record["tolerances"]), "", *_singular(record["singular"])]
    return "\n".join([*lines, "", *_weights(record["weights"]), ""])


def _tolerances(cases: list[Record]) -> Iterator[str]:
    yield "## Tolerances: function values, share of runs within the tolerance, processor milliseconds"
    yield ""
    runs = next(iter(cases[0]["rules"].values()))["runs"]
    yield f"Promised: 95 %. {runs} runs each; shares below 88 % are misses (**bold**)."
    yield ""
    names = list(cases[0]["rules"])
    yield f"| integrand | {' | '.join(names)} |"
    yield f"|---|{'---|' * len(names)}"
    for case in cases:
        cells = [_cell(case["rules"][name], case["atol"]) for name in names]
        yield f"| {case['integrand']}, d = {case['d']}, {case['atol']:g} | {' | '.join(cells)} |"


def _cell(rule: Record, atol: float) -> str:
    within = float(np.mean(np.array(rule["errors"]) <= atol))
    share = f"{within:.0%}" if within >= 0.88 else f"**{within:.0%}**"
    return f"{rule['values']:,.0f}; {share}; {1e3 * rule['seconds']:.0f}"


def _singular(rules: dict[str, Record]) -> Iterator[str]:
    yield f"## The singular integrand with {N:,} function values in all"
    yield ""
    yield "Five dimensions, |x - 1|^-2.4 under a normal density. One BLAS thread; 95 % intervals."
    yield ""
    yield "| method | relative error (RMSE) | covered | seconds | times the first | runs |\n|---|---|---|---|---|---|"
    first = next(iter(rules.values()))["seconds"]
    for name, rule in rules.items():
        figures = f"{rule['rmse']:.1e} | {rule['covered']:.0%} | {rule['seconds']:.2f} | {rule['seconds'] / first:.2g}"
        yield f"| {name} | {figures} | {rule['runs']} |"


def _weights(cases: list[Record]) -> Iterator[str]:
    yield "## Optimal weights to a relative duality gap of 1e-6"
    yield ""
    yield "| rows | components | seconds | gap |\n|---|---|---|---|"
    for case in cases:
        yield f"| {case['rows']:,} | {case['components']:,} | {case['seconds']:.2f} | {case['gap']:.1e} |"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, keep the record, write the tables."""
    parser = argparse.ArgumentParser(prog="python -m benches.estimators", description=__doc__)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--report", type=Path, default=HERE / "ESTIMATORS.md")
    options = parser.parse_args(arguments)
    warnings.simplefilter("ignore")  # of the others
    record: Record = {"machine": describe(), "tolerances": [], "singular": {}}
    for name, d, atol in PROBLEMS:
        print(name, d, file=sys.stderr)
        f = integrands.build(name, d)
        rules = {rule: measure(run, f.exact, options.runs) for rule, run in tolerance_rules(f, atol).items()}
        record["tolerances"].append({"integrand": name, "d": d, "atol": atol, "rules": rules})
    problem = singularity()
    for rule, run in singular_rules(problem).items():
        print(rule, file=sys.stderr)
        runs = max(1, options.runs // 4) if rule == "pypmc" else options.runs
        record["singular"][rule] = measure(run, problem.exact, runs)
    record["weights"] = [optimize(*size) for size in SIZES]
    raw = HERE.parent / "out" / "bench-estimators.json"
    raw.parent.mkdir(exist_ok=True)
    raw.write_text(json.dumps(record, indent=1))
    options.report.write_text(to_markdown(record))
    print(options.report.read_text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
