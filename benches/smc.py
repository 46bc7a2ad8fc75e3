"""Particle filters measured: error and processor time with random and with evenly spread numbers, against `particles`.

That package needs NumPy 1, so that it lives in an environment of its own: EVENLIGHT_PARTICLES names its interpreter, as
after ``python3.11 -m venv ~/particles && ~/particles/bin/pip install particles==0.4 numba``.
"""

from __future__ import annotations

import json
import os
import subprocess
import time
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from evenlight import smc
from evenlight.points import Sobol

PARTICLES = 4096
STEPS = 100
RUNS = 24


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


def ours(case: Case, points: Any) -> tuple[float, float]:
    """Root mean squared error of the logarithm, and milliseconds of a run."""
    settings: dict[str, Any] = {"particles": PARTICLES, "points": points}
    smc.filter(case.model, case.observations, **settings, replicates=1, seed=1)
    spent, logarithms = [], []
    for seed in range(RUNS):
        started = time.process_time()
        run = smc.filter(case.model, case.observations, **settings, replicates=1, seed=seed)
        spent.append(time.process_time() - started)
        logarithms.append(run.value)
    return float(np.sqrt(np.mean((np.array(logarithms) - case.truth) ** 2))), 1e3 * float(np.median(spent))


def theirs(case: Case) -> list[tuple[float, float]]:
    """The same of `particles`, for random numbers and for its SQMC; nothing where it is not installed."""
    python = os.environ.get("EVENLIGHT_PARTICLES")
    if python is None:
        return []
    linear = isinstance(case.model, smc.LinearGaussian)
    job = {
        "y": case.observations.tolist(),
        "transition": case.model.transition.tolist() if linear else None,
        "noise": float(case.model.observation_noise[0, 0]) if linear else None,
        "covariance": case.model.covariance.tolist() if linear else None,
        "particles": PARTICLES,
        "runs": RUNS // 2,
    }
    script = Path(__file__).with_name("particle_filter_peer.py")
    limits = {**os.environ, "OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    done = subprocess.run(
        [python, str(script)], input=json.dumps(job), env=limits, capture_output=True, text=True, check=True
    )
    found = json.loads(done.stdout.splitlines()[-1])
    return [
        (float(np.sqrt(np.mean((np.array(logarithms) - case.truth) ** 2))), 1e3 * spent) for logarithms, spent in found
    ]


def report() -> None:
    """A row for each model and program."""
    print(f"{PARTICLES} particles, {STEPS} observations; gain: ratio of MSE x time of random to evenly spread numbers")
    print("| model | program | RMSE random | ms | RMSE SQMC | ms | gain | SQMC's time |")
    print("|---|---|---|---|---|---|---|---|")
    for case in cases():
        rows = {"evenlight": [ours(case, None), ours(case, Sobol)], "particles": theirs(case)}
        own = rows["evenlight"][1][1]
        for program, found in rows.items():
            if found:
                (error, spent), (even_error, even_spent) = found
                gain = (error / even_error) ** 2 * spent / even_spent
                print(
                    f"| {case.name} | {program} | {error:.4f} | {spent:.1f} | {even_error:.5f} | {even_spent:.1f} | "
                    f"{gain:.2f} | {even_spent / own:.1f} x |",
                    flush=True,
                )


if __name__ == "__main__":
    report()
