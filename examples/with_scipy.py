"""evenlight's points where NumPy, SciPy and parallel code already are: distributions, engines, blocks.

    python examples/with_scipy.py --n 65536

A job has two stages, one of log-normal and one of gamma length. What part of it is beyond 10 hours, in the mean?
"""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray
from scipy import integrate, stats

import evenlight
from evenlight.points import Sobol
from evenlight.warp import Frozen

Array = NDArray[np.float64]

STAGES = Frozen(stats.lognorm(0.5, scale=3.0), stats.gamma(2.0, scale=1.5))  # from the unit square to hours
LIMIT = 10.0


def excess(u: Array) -> Array:
    """Hours beyond the limit, of rows of uniform numbers."""
    return np.asarray(np.maximum(STAGES.map(u).sum(axis=-1) - LIMIT, 0))


def exact() -> float:
    """The same by quadrature: E max(A + B - c, 0) is E m(c - B), with m(t) = E max(A - t, 0) known for log-normal A."""
    first, second = stats.lognorm(0.5, scale=3.0), stats.gamma(2.0, scale=1.5)

    def beyond(t: float) -> float:
        if t <= 0:
            return float(first.mean()) - t
        d = (np.log(3.0 / t) + 0.25) / 0.5
        return float(first.mean() * stats.norm.cdf(d) - t * stats.norm.cdf(d - 0.5))

    return float(integrate.quad(lambda b: beyond(LIMIT - b) * second.pdf(b), 0, 60, points=[LIMIT], limit=200)[0])


def in_blocks(n: int, replicates: int = 16, blocks: int = 4) -> tuple[float, float]:
    """Mean and standard error from blocks of rows; any worker can make any block, since rows have random access.

    With Dask, `dask.delayed(block)(k)` in place of the pool; nothing but numbers need travel.
    """
    rows = n // replicates // blocks

    def block(k: int) -> Array:
        u = Sobol(2, seed=1).points(k * rows, (k + 1) * rows, replicates=replicates)  # (replicates, rows, 2)
        return np.asarray(excess(u).sum(axis=1))

    with ThreadPoolExecutor() as pool:
        means = sum(pool.map(block, range(blocks))) / (rows * blocks)
    return float(np.mean(means)), float(np.std(means, ddof=1) / np.sqrt(replicates))


def main(arguments: list[str] | None = None) -> int:
    """Answer the question in four ways."""
    parser = argparse.ArgumentParser(description="The same mean by evenlight, by blocks and by SciPy.")
    parser.add_argument("--n", type=int, default=2**16, help="function values, a power of 2 (%(default)s)")
    n = parser.parse_args(arguments).n
    print(f"quadrature          {exact():.6f}")
    print(f"integrate           {evenlight.integrate(excess, Sobol(2, seed=1), n=n)}")
    print("in blocks           {:.6f} ± {:.6f}".format(*in_blocks(n)))
    by_scipy = integrate.qmc_quad(
        lambda u: excess(np.minimum(u.T, np.nextafter(1, 0))),  # SciPy tries the corner 1 itself
        *([0, 0], [1, 1]),
        **{"n_estimates": 16, "n_points": n // 16, "qrng": Sobol(2, seed=1)},
    )
    print(f"scipy's qmc_quad    {by_scipy.integral:.6f} ± {by_scipy.standard_error:.6f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
