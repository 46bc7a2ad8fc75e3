"""Runs of chains that go on: with couplings and without draws, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from evenlight.mcmc import HMC, LFSR, NUTS, Antithetic, Chains, Gibbs, HerdedGibbs, RandomWalk, Stratified, run

WRONG: Any = 3
GIBBS = Gibbs([lambda x, u: 0.5 * x[:, 1] + u, lambda x, u: 0.5 * x[:, 0] + u])


def normal(x: Any) -> Any:
    return -0.5 * (x**2).sum(axis=1)


def minus(x: Any) -> Any:
    return -x


def square(x: Any) -> Any:
    return x**2


WALK = RandomWalk(normal)


def earlier(**changes: Any) -> Chains:
    return run(WALK, [0.0, 1.0], **({"n": 10, "warm_up": 60, "burn_in": 3, "seed": 7} | changes))


@pytest.mark.parametrize("points", [Antithetic(), Stratified(4)], ids=lambda points: points.name)
def test_coupled_chains_go_on(points: Any) -> None:
    whole = run(GIBBS, [0.0, 1.0], n=30, points=points, seed=2)
    part = run(GIBBS, [0.0, 1.0], n=11, points=points, seed=2)
    assert (run(GIBBS, [0.0, 1.0], n=30, points=points, seed=2, resume=part).kept_draws() == whole.kept_draws()).all()


def test_lean_runs_and_deterministic_ones_go_on() -> None:
    lean: dict[str, Any] = {"functionals": {"square": square}, "keep_draws": False}
    part, whole = (earlier(n=n, **lean) for n in (10, 25))
    more = earlier(n=25, resume=part, **lean)
    assert more.draws is None
    assert (more.means["square"] == whole.means["square"]).all()
    herded = HerdedGibbs(lambda x, j: 0.3 + 0.4 * x[:, 1 - j])
    start = np.zeros((2, 2))
    more = run(herded, start, n=30, resume=run(herded, start, n=10))
    assert (more.kept_draws() == run(herded, start, n=30).kept_draws()).all()


def test_the_same_settings_are_the_same_kernel() -> None:
    part = run(HMC(normal, minus, covariance=[1.0, 2.0]), [0.0, 1.0], n=5)
    assert run(HMC(normal, minus, covariance=[1.0, 2.0]), [0.0, 1.0], n=9, resume=part).n == 9


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: earlier(n=20, resume=WRONG), TypeError, "resume must be Chains of an earlier run, not int"),
        (lambda: earlier(n=10, resume=earlier()), ValueError, "has 10 steps already, n must be more, not 10"),
        (lambda: earlier(n=20, seed=8, resume=earlier()), ValueError, "its seed is 7, not 8"),
        (lambda: earlier(n=20, warm_up=0, resume=earlier()), ValueError, r"its warm_up and burn_in is \(60, 3\)"),
        (lambda: earlier(n=20, chains=8, resume=earlier()), ValueError, r"its shape is \(4, 2\), not \(8, 2\)"),
        (lambda: earlier(n=20, points=Antithetic(), resume=earlier()), ValueError, "its points is Independent"),
        (lambda: earlier(n=20, functionals={"s": square}, resume=earlier()), ValueError, "its functionals is"),
        (lambda: earlier(n=20, keep_draws=False, resume=earlier()), ValueError, "its kept draws is True"),
        (
            lambda: run(RandomWalk(normal, scale=2.0), [0.0, 1.0], n=20, resume=earlier()),
            ValueError,
            "another kernel: scale differs",
        ),
        (lambda: run(GIBBS, [0.0, 1.0], n=20, resume=earlier()), ValueError, "'random_walk' and not 'gibbs'"),
        (
            lambda: run(GIBBS, [0.0, 1.0], points=LFSR(10), resume=run(GIBBS, [0.0, 1.0], points=LFSR(10))),
            ValueError,
            "cannot grow: its numbers are balanced as a whole",
        ),
        (
            lambda: run(WALK, [1.0], n=20, resume=NUTS(normal, minus).run([1.0], n=4, warm_up=10)),
            ValueError,
            "its kind, 'nuts' and not 'random_walk'",
        ),
    ],
)
def test_only_the_same_run_goes_on(call: Any, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        call()
