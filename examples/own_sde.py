"""A stochastic differential equation of one's own by multilevel Monte Carlo, with random and with evenly spread points.

    python examples/own_sde.py --rmse 0.001 -o own_sde.png

The equation is that of Cox, Ingersoll and Ross, dX = κ (θ - X) dt + σ √X dW, and the quantity E max(X_1 - K, 0).
Level l takes 2^l time steps of Euler's scheme; its coarse path takes half as many, with the sums of the same Brownian
increments.
"""

from __future__ import annotations

import argparse
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.multilevel import Coupled, LevelSampler, brownian_increments, level_figure, level_table, mlmc, mlqmc

Array = NDArray[np.float64]


class SquareRootProcess(LevelSampler):
    """The payoff max(X_1 - K, 0); all a method needs to know is `dims`, `cost` and `sample`."""

    name = "square root process"

    def __init__(self, kappa: float = 2.0, theta: float = 1.0, sigma: float = 0.5, strike: float = 1.0) -> None:
        self.kappa, self.theta, self.sigma, self.strike = kappa, theta, sigma, strike

    def dims(self, level: int) -> int:
        """One uniform number for each time step of the fine path."""
        return 1 << level

    def cost(self, level: int) -> float:
        """Time steps of both paths."""
        return (1 << level) + (1 << level >> 1)

    def sample(self, level: int, u: Array) -> Coupled:
        """Payoffs of the fine and the coarse path of the same Brownian motions, one in each row."""
        steps = brownian_increments(u, construction="bridge")  # over [0, 1], the most important numbers first
        fine = self.payoff(steps)
        coarse = self.payoff(steps[:, ::2] + steps[:, 1::2]) if level else np.zeros(len(u))
        return Coupled(fine, coarse, len(u) * self.cost(level))

    def payoff(self, increments: Array) -> Array:
        """Euler's scheme, with the root of the positive part, from X_0 = θ."""
        x = np.full(len(increments), self.theta)
        dt = 1 / increments.shape[1]
        for dw in increments.T:
            x = x + self.kappa * (self.theta - x) * dt + self.sigma * np.sqrt(np.maximum(x, 0)) * dw
        return np.maximum(x - self.strike, 0)


def main(arguments: list[str] | None = None) -> int:
    """Estimate by both methods, print the tables and draw the levels."""
    parser = argparse.ArgumentParser(description="Multilevel estimates of a square root process.")
    parser.add_argument("--rmse", type=float, default=1e-3, help="root mean squared error (%(default)s)")
    parser.add_argument("-o", "--output", default="own_sde.png")
    options = parser.parse_args(arguments)
    methods: dict[str, Any] = {"mlmc": mlmc, "mlqmc": mlqmc}
    for name, method in methods.items():
        estimate = method(SquareRootProcess(), rmse=options.rmse, seed=1)
        low, high = estimate.confidence_interval(0.95)
        print(f"{name}: {estimate.value:.5f} in [{low:.5f}, {high:.5f}], {estimate.cost:.3g} time steps")
        print(level_table(estimate), end="\n\n")
        if name == "mlmc":
            level_figure(estimate).savefig(options.output, dpi=120)
    return 0


if __name__ == "__main__":
    sys.exit(main())
