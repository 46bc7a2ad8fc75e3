"""Chains measured: independent draws for each second of processor time, against nutpie and BlackJAX in the same run."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy import special

from evenlight.mcmc import HMC, LCG, LFSR, MALA, NUTS, Gibbs, Microcanonical, Permuted, RandomWalk, run
from evenlight.mcmc.diagnostics import diagnose
from evenlight.points import Sobol

Measured = tuple[Any, float]  # draws (chains, n, d) and seconds of compilation


def targets() -> dict[str, np.ndarray]:
    """Covariances of the normal targets."""
    ten = 0.9 ** np.abs(np.subtract.outer(np.arange(10), np.arange(10)))
    return {"10-D, 0.9^|i-j|": ten, "2-D, 0.99": np.array([[1, 0.99], [0.99, 1]])}


def samplers(covariance: np.ndarray) -> dict[str, Callable[[], Measured]]:
    """Ours and the peers'; all start at the origin, and their warm-up counts."""
    d, inverse = len(covariance), np.linalg.inv(covariance)

    def log_density(x: Any) -> Any:
        return -0.5 * ((x @ inverse) * x).sum(axis=1)

    def gradient(x: Any) -> Any:
        return -x @ inverse

    def ours(kernel: Any, n: int, warm_up: int) -> Callable[[], Measured]:
        return lambda: (run(kernel, np.zeros(d), n=n, chains=64, warm_up=warm_up, seed=1).kept_draws(), 0.0)

    nuts = NUTS(log_density, gradient)
    return {
        "evenlight RandomWalk": ours(RandomWalk(log_density), 4000, 1000),
        "evenlight MALA": ours(MALA(log_density, gradient), 3000, 1000),
        "evenlight HMC": ours(HMC(log_density, gradient, step_size=0.2, steps=12), 1000, 500),
        "nutpie, functions of NumPy": lambda: (nuts.run(np.zeros(d), n=1000, warm_up=500).kept_draws(), 0.0),
        **_blackjax(inverse),
    }


def _blackjax(inverse: np.ndarray) -> dict[str, Callable[[], Measured]]:
    """NUTS with window adaptation, four chains side by side, compiled by JAX; nothing where it is not installed."""
    try:
        import blackjax
        import jax
    except ImportError:
        return {}

    def measure() -> Measured:
        precision = jax.numpy.asarray(inverse)

        def log_density(x: Any) -> Any:
            return -0.5 * x @ precision @ x

        def chain(key: Any) -> Any:
            tuning, sampling = jax.random.split(key)
            adaptation = blackjax.window_adaptation(blackjax.nuts, log_density)
            (state, parameters), _ = adaptation.run(tuning, jax.numpy.zeros(len(inverse)), 1000)
            step = blackjax.nuts(log_density, **parameters).step

            def advance(state: Any, key: Any) -> Any:
                state, _ = step(key, state)
                return state, state.position

            return jax.lax.scan(advance, state, jax.random.split(sampling, 2500))[1]

        keys = jax.random.split(jax.random.key(1), 4)
        started = time.process_time()
        compiled = jax.jit(jax.vmap(chain)).lower(keys).compile()
        compilation = time.process_time() - started
        return np.asarray(compiled(keys), np.float64), compilation

    return {"BlackJAX NUTS, compiled": measure}


def speed() -> None:
    """Worth of the draws by their least bulk ESS, for each second of processor time, warm-up included."""
    print("| target | sampler | draws | s | s to compile | least ESS | ESS / s |\n|---|---|---|---|---|---|---|")
    for name, covariance in targets().items():
        for sampler, measure in samplers(covariance).items():
            started = time.process_time()
            draws, compilation = measure()
            spent = time.process_time() - started - compilation
            worth = diagnose(draws, np.ones(len(draws)), True).ess_bulk.min()
            size = f"{draws.shape[0]} x {draws.shape[1]}"
            print(
                f"| {name} | {sampler} | {size} | {spent:.2f} | {compilation:.1f} | {worth:.0f} | {worth / spent:.0f} |"
            )


def funnel() -> None:
    """R. M. Neal's, in ten dimensions and as he wrote it: who mixes; quantiles of v, all warm-ups included."""

    def log_density(x: Any) -> Any:
        return -(x[:, 0] ** 2) / 18 - 0.5 * (x[:, 1:] ** 2).sum(axis=1) * np.exp(-x[:, 0]) - 4.5 * x[:, 0]

    def gradient(x: Any) -> Any:
        inverse = np.exp(-x[:, 0])
        of_v = -x[:, 0] / 9 + 0.5 * (x[:, 1:] ** 2).sum(axis=1) * inverse - 4.5
        return np.column_stack([of_v, -x[:, 1:] * inverse[:, None]])

    start = np.random.default_rng(0).normal(size=(24, 10)) * (np.arange(10) > 0)
    nuts = NUTS(log_density, gradient, target_acceptance=0.95)
    small = HMC(log_density, gradient, step_size=0.05, steps=300)
    many = Microcanonical(log_density, gradient, steps=300)
    runs: dict[str, Callable[[], Any]] = {
        "evenlight Microcanonical": lambda: run(many, start, n=1200, burn_in=100, seed=1),
        "evenlight HMC, small steps": lambda: run(small, start, n=500, burn_in=100, seed=1),
        "nutpie, functions of NumPy": lambda: nuts.run(np.full(10, 0.1), n=1000, warm_up=500, seed=1),
    }
    print("| sampler | s | R-hat of v | bulk ESS | tail ESS | ESS / s | divergences |\n|---|---|---|---|---|---|---|")
    for sampler, measure in runs.items():
        started = time.process_time()
        chains = measure()
        spent = time.process_time() - started
        found = chains.diagnostics(lambda x: x[:, 0])
        bulk, tail, r_hat = found.ess_bulk[0], found.ess_tail[0], found.r_hat[0]
        print(
            f"| {sampler} | {spent:.1f} | {r_hat:.3f} | {bulk:.0f} | {tail:.0f} | {bulk / spent:.1f} "
            f"| {found.divergences} |"
        )


def reductions() -> None:
    """Variances of means over Gibbs chains, independent numbers over driving sequences; 200 repetitions each."""
    rest = 0.75**0.5
    gibbs = Gibbs(
        [lambda x, u: x[:, 1] / 2 + rest * special.ndtri(u), lambda x, u: x[:, 0] / 2 + rest * special.ndtri(u)]
    )
    functionals = {"E x1": (lambda x: x[:, 0], 0.0), "E x1 x2": (lambda x: x[:, 0] * x[:, 1], 0.5)}
    settings: dict[str, Any] = {
        "chains": 200,
        "functionals": {name: functional for name, (functional, _) in functionals.items()},
        "keep_draws": False,
    }
    print("| numbers | n | E x1 | E x1 x2 | us for each step |\n|---|---|---|---|---|")
    for points in (LFSR(10, "chen"), LFSR(10), LFSR(12), LFSR(14), LCG(10), Permuted(Sobol(2))):
        n = points.length(2) or 1024
        started = time.process_time()
        even = run(gibbs, [0, 0], n=n, points=points, seed=1, **settings)
        spent = 1e6 * (time.process_time() - started) / (200 * n)
        random = run(gibbs, [0, 0], n=n, seed=2, **settings)
        found = [
            np.mean((random.means[name] - exact) ** 2) / np.mean((even.means[name] - exact) ** 2)
            for name, (_, exact) in functionals.items()
        ]
        print(f"| {points!r} | {n} | {found[0]:.0f} | {found[1]:.0f} | {spent:.2f} |")


if __name__ == "__main__":
    warnings.simplefilter("ignore", FutureWarning)
    speed()
    print()
    funnel()
    print()
    reductions()
