"""Particle filters measured: error and processor time with random and with evenly spread numbers, against `particles`.

That package needs NumPy 1, so that it lives in an environment of its own: EVENLIGHT_PARTICLES names its interpreter, as
after ``python3.11 -m venv ~/particles && ~/particles/bin/pip install particles==0.4 numba``.
"""

from __future__ import annotations

import argparse
import functools
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from benches.machine import describe
from evenlight import smc
from evenlight.points import Sobol

Array = NDArray[np.float64]

PARTICLES = 4096
STEPS = 100
ROUNDS = 4
HEAD = """# Particle filters measured

Written by `make bench-smc`; figures of one run on one machine. Ratios are what counts.

{machine}

{particles} particles, {steps} observations, {runs} runs each; `particles` 0.4 in an environment of its own takes turns
with ours in {rounds} rounds. Errors are of the logarithm of the likelihood, with their standard errors; ms is the
median processor time of a run on one thread. *Gain* is the ratio of mean squared error times time, random to evenly
spread numbers; *time* is that of sequential quasi-Monte Carlo over ours.
"""
COLUMNS = (
    "| model | program | RMSE random | ms | RMSE SQMC | ms | gain | time |",
    "|---|---|---|---|---|---|---|---|",
)


class Case(NamedTuple):
    """A model, what was observed of it, and the logarithm of its likelihood."""

    name: str
    model: Any
    observations: Any
    truth: float


def cases() -> list[Case]:
    """Linear Gaussian models in 1, 2 and 4 dimensions, and stochastic volatility."""
    generator = np.random.default_rng(3)
    found = []
    for d, pull, noise in ((1, 0.9, 0.2), (2, 0.4, 0.5), (4, 0.4, 0.5)):
        places = np.arange(d)
        transition = [[0.9]] if d == 1 else pull ** (1 + np.abs(places[:, None] - places))
        model = smc.LinearGaussian(transition, np.eye(d), np.eye(d), noise**2 * np.eye(d))
        y = _walk(model, generator) + noise * generator.normal(size=(STEPS, d))
        found.append(Case(f"linear Gaussian, d = {d}", model, y, smc.kalman(model, y).log_likelihood))
    volatility = smc.StochasticVolatility()
    y = np.exp(_walk(volatility, generator)[:, 0] / 2) * generator.normal(size=STEPS)
    reference = smc.filter(volatility, y, particles=2**16, points=Sobol, replicates=8, seed=99)
    return [*found, Case("stochastic volatility", volatility, y, reference.value)]


def _walk(model: smc.StateSpaceModel, generator: np.random.Generator) -> Any:
    states = [model.init(generator.random((1, model.init_uniforms)))]
    for t in range(1, STEPS):
        states.append(model.move(t, states[-1], generator.random((1, model.move_uniforms))))
    return np.concatenate(states)


class Measured(NamedTuple):
    """Of runs with one kind of numbers: errors of the logarithm, and seconds of processor time."""

    errors: Array
    seconds: Array

    def joined(self, other: Measured) -> Measured:
        """With the runs of another round."""
        return Measured(*(np.concatenate(both) for both in zip(self, other, strict=True)))

    @property
    def milliseconds(self) -> float:
        """The median of a run."""
        return 1e3 * float(np.median(self.seconds))

    @property
    def square(self) -> float:
        """The mean squared error."""
        return float(np.mean(self.errors**2))

    @property
    def doubt(self) -> float:
        """The relative standard error of the mean squared error."""
        return float(np.std(self.errors**2, ddof=1) / np.sqrt(len(self.errors)) / self.square)


def ours(case: Case, points: Any, seeds: range) -> Measured:
    """A run of each seed, after one that warms up."""
    settings: dict[str, Any] = {"particles": PARTICLES, "points": points, "replicates": 1}
    smc.filter(case.model, case.observations, **settings, seed=seeds.start)
    spent, logarithms = [], []
    for seed in seeds:
        started = time.process_time()
        run = smc.filter(case.model, case.observations, **settings, seed=seed)
        spent.append(time.process_time() - started)
        logarithms.append(run.value)
    return Measured(np.array(logarithms) - case.truth, np.array(spent))


def theirs(case: Case, python: str, runs: int) -> list[Measured]:
    """The same of `particles`, for random numbers and for its SQMC."""
    linear = isinstance(case.model, smc.LinearGaussian)
    job = {
        "y": case.observations.tolist(),
        "transition": case.model.transition.tolist() if linear else None,
        "noise": float(case.model.observation_noise[0, 0]) if linear else None,
        "covariance": case.model.covariance.tolist() if linear else None,
        "particles": PARTICLES,
        "runs": runs,
    }
    script = Path(__file__).with_name("particle_filter_peer.py")
    limits = {**os.environ, "OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    done = subprocess.run(
        [python, str(script)], input=json.dumps(job), env=limits, capture_output=True, text=True, check=True
    )
    found = json.loads(done.stdout.splitlines()[-1])
    return [Measured(np.array(logarithms) - case.truth, np.array(spent)) for logarithms, spent in found]


def measured(case: Case, python: str, runs: int) -> dict[str, list[Measured]]:
    """Random and evenly spread numbers of both programs, which take turns so that both meet the same machine."""
    each = runs // ROUNDS
    rounds = []
    for first in range(0, runs, each):
        seeds = range(first, min(first + each, runs))
        own = [ours(case, points, seeds) for points in (None, Sobol)]
        rounds.append([*own, *theirs(case, python, len(seeds))])
    joined = [functools.reduce(Measured.joined, kind) for kind in zip(*rounds, strict=True)]
    return {"evenlight": joined[:2], "particles": joined[2:]}


def rows(python: str, runs: int) -> Iterator[str]:
    """A row for each model and program."""
    for case in cases():
        found = measured(case, python, runs)
        own = found["evenlight"][1].milliseconds
        for program, (random, even) in found.items():
            gain = random.square * random.milliseconds / (even.square * even.milliseconds)
            cells = [
                f"{random.square**0.5:.4f} ± {random.doubt / 2:.0%}",
                f"{random.milliseconds:.1f}",
                f"{even.square**0.5:.5f} ± {even.doubt / 2:.0%}",
                f"{even.milliseconds:.1f}",
                f"{gain:.3g} ± {np.hypot(random.doubt, even.doubt):.0%}",
                f"{even.milliseconds / own:.1f}",
            ]
            yield f"| {case.name} | {program} | {' | '.join(cells)} |"


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure and write the table."""
    parser = argparse.ArgumentParser(prog="benches.smc", description=__doc__)
    parser.add_argument("--runs", type=int, default=200, help="of each model, program and kind of numbers")
    parser.add_argument("--report", type=Path, default=Path(__file__).with_name("SMC.md"))
    options = parser.parse_args(arguments)
    python = os.environ.get("EVENLIGHT_PARTICLES")
    if python is None or not os.access(python, os.X_OK):
        print(
            "EVENLIGHT_PARTICLES must name a Python that has the package `particles`; to make one: "
            "python3.11 -m venv ~/particles && ~/particles/bin/pip install particles==0.4 numba",
            file=sys.stderr,
        )
        return 2
    if options.runs < ROUNDS:
        parser.error(f"--runs must be at least {ROUNDS}, not {options.runs}")
    machine = "; ".join(f"{key}: {value}" for key, value in describe().items())
    lines = [HEAD.format(machine=machine, runs=options.runs, rounds=ROUNDS, particles=PARTICLES, steps=STEPS), *COLUMNS]
    for row in rows(python, options.runs):
        print(row, flush=True)
        lines.append(row)
    options.report.write_text("\n".join(lines) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
