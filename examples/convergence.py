"""How fast errors fall on a smooth, a kinky and a discontinuous function: Monte Carlo, and points of low discrepancy.

    python examples/convergence.py --most 16384 -o convergence.png

Theory for d = 2: Monte Carlo n^-1/2 whatever the function. Scrambled Sobol' points nearly n^-3/2 where the function is
smooth, n^-3/4 across a jump along a curve; a kink is between the two. Slopes are printed with their standard errors.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenlight.figures import empty_figure
from evenlight.lab import rates
from evenlight.points import Engine, Halton, Independent, Sobol

Array = NDArray[np.float64]


def smooth(x: Array) -> Array:
    """A product of exponentials, with the integral (e - 1)^2."""
    return np.asarray(np.exp(x.sum(axis=1)))


def kink(x: Array) -> Array:
    """The payoff of an option, max(x + y - 1, 0), with the integral 1/6: continuous, not differentiable on a line."""
    return np.asarray(np.maximum(x.sum(axis=1) - 1, 0))


def jump(x: Array) -> Array:
    """The indicator of a quarter of a disk, with the integral pi / 4."""
    return np.asarray((x**2).sum(axis=1) < 1, np.float64)


FUNCTIONS: tuple[tuple[Callable[[Array], Array], float], ...] = (
    (smooth, (np.e - 1) ** 2),
    (kink, 1 / 6),
    (jump, np.pi / 4),
)
POINTS: tuple[Engine, ...] = (Independent(2, seed=1), Halton(2, seed=1), Sobol(2, seed=1))


def main(arguments: list[str] | None = None) -> int:
    """Measure, print and draw."""
    parser = argparse.ArgumentParser(description="Errors against n for three functions and three kinds of points.")
    parser.add_argument("--most", type=int, default=2**14, help="points, a power of 2 (%(default)s)")
    parser.add_argument("--replicates", type=int, default=100, help="randomizations (%(default)s)")
    parser.add_argument("-o", "--output", default="convergence.png")
    options = parser.parse_args(arguments)
    figure = empty_figure(11, 4)
    panels: list[Any] = list(figure.subplots(1, len(FUNCTIONS)))
    for panel, (function, exact) in zip(panels, FUNCTIONS, strict=True):
        for points in POINTS:
            found = rates(function, points, exact=exact, most=options.most, replicates=options.replicates)
            print(f"{function.__name__:>7}, {points.sequence:>11}: n^({found.slope:.2f} ± {found.slope_error:.2f})")
            relative = 1 / np.sqrt(2 * options.replicates)  # of a root mean square of normal errors
            panel.errorbar(found.n, found.rmse, 2 * relative * found.rmse, marker=".", label=points.sequence)
        panel.set_xscale("log", base=2)
        panel.set_yscale("log")
        panel.set(title=function.__name__, xlabel="points", ylabel="root mean squared error")
    panels[0].legend()
    figure.savefig(options.output, dpi=120)
    return 0


if __name__ == "__main__":
    sys.exit(main())
