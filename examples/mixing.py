"""Why some chains mix slowly: a walk takes the square of the distance, one with momentum the distance; and far modes.

    python examples/mixing.py -o mixing.png

The laws of the walks on a cycle are exact, no simulation. The far modes are two normals of weights 1/4 and 3/4, at
a distance of 16 standard deviations.
"""

from __future__ import annotations

import argparse
import sys

from evenlight.figures import empty_figure
from evenlight.lab import far_modes, mixing_lesson

NAMES = {"walk": "random walk", "lifted": "lifted walk"}


def main(arguments: list[str] | None = None) -> int:
    """Measure, print and draw."""
    parser = argparse.ArgumentParser(description="Steps to mix against the size, and tempering.")
    parser.add_argument("--most", type=int, default=128, help="states of the largest cycle (%(default)s)")
    parser.add_argument("--steps", type=int, default=2000, help="of chains on far modes (%(default)s)")
    parser.add_argument("-o", "--output", default="mixing.png")
    options = parser.parse_args(arguments)
    sizes = [16 * 2**k for k in range((options.most // 16).bit_length())]

    figure = empty_figure(6, 4.5)
    panel = figure.subplots()
    for name, title in NAMES.items():
        lesson = mixing_lesson(name, sizes)
        print(f"{title}: steps to mix grow as N^{lesson.exponent:.2f}; theory says N^{lesson.claimed:.0f}")
        panel.loglog(lesson.sizes, lesson.costs, "-o", base=2, label=f"{title}, N^{lesson.exponent:.2f}")
    panel.set(xlabel="states of the cycle", ylabel="steps to total variation 1/4")
    panel.legend()
    figure.savefig(options.output, dpi=120)

    modes = far_modes(n=options.steps)
    print("The weight of the left mode, 1/4:")
    for how, estimate, r_hat in zip(
        ("walks from the left mode", "walks from both modes", "parallel tempering"),
        (modes.alone, modes.spread, modes.tempered),
        modes.r_hat,
        strict=True,
    ):
        print(f"{how:>26}: {estimate.value:.3f} ± {estimate.standard_error:.3f}, R-hat {r_hat:.2f}")
    print("R-hat of the first is near 1 although it is wrong: no diagnostic sees a mode where no chain has been.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
