"""Runs `particles` on the job on standard input, under an interpreter that has it; alone, without evenlight."""

from __future__ import annotations

import json
import sys
import time
import warnings
from typing import Any

import numpy as np
import particles
from particles import kalman, state_space_models


def feynman_kac(job: Any) -> Any:
    """The bootstrap filter of the job's model."""
    y = np.array(job["y"])
    if job["transition"] is None:
        model = state_space_models.StochVol(mu=-1.0, rho=0.95, sigma=0.2)
        return state_space_models.Bootstrap(ssm=model, data=list(y))
    transition = np.array(job["transition"])
    d = len(transition)
    if d == 1:
        model = kalman.LinearGauss(rho=transition[0, 0], sigmaX=1.0, sigmaY=job["noise"] ** 0.5)
        return state_space_models.Bootstrap(ssm=model, data=list(y[:, 0]))
    model = kalman.MVLinearGauss(
        F=transition,
        G=np.eye(d),
        covX=np.eye(d),
        covY=job["noise"] * np.eye(d),
        mu0=np.zeros(d),
        cov0=np.array(job["covariance"]),
    )
    return state_space_models.Bootstrap(ssm=model, data=[row[np.newaxis] for row in y])


def measure(job: Any, qmc: bool) -> tuple[list[float], list[float]]:
    """Logarithms of likelihoods, and processor seconds of each run, without the first."""
    model = feynman_kac(job)
    logarithms, spent = [], []
    for _ in range(job["runs"] + 1):
        started = time.process_time()
        run = particles.SMC(fk=model, N=job["particles"], qmc=qmc)
        run.run()
        spent.append(time.process_time() - started)
        logarithms.append(float(run.logLt))
    return logarithms[1:], spent[1:]


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    job = json.load(sys.stdin)
    print(json.dumps([measure(job, False), measure(job, True)]))
