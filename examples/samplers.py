"""Which sampler for my scene? Errors against samples per pixel, with error bars, as a table and a plot.

    python examples/samplers.py scenes/box.xml --size 64x64 --most 256 -o samplers.png

The error of an image is the root mean square over pixels of the standard error of their luminance. Its error bar comes
from renders with other seeds. The last column says how many independent samples the same error would take.
"""

from __future__ import annotations

import argparse
import sys

import numpy as np
from numpy.typing import NDArray

import evenlight
from evenlight.figures import empty_figure

SAMPLERS = ("independent", "halton", "sobol", "zsobol")
REPLICATES = 4  # per render: their spread is the error
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def error_of_image(scene: evenlight.Scene, sampler: str, spp: int, size: tuple[int, int], seed: int) -> float:
    """Render once, and give the root mean square of the pixels' standard errors."""
    film = evenlight.render(scene, sampler=sampler, spp=spp, replicates=REPLICATES, size=size, seed=seed)
    luminance = film.replicates @ LUMINANCE
    return float(np.sqrt((luminance.var(axis=0, ddof=1) / REPLICATES).mean()))


def measure(scene: evenlight.Scene, counts: list[int], size: tuple[int, int], repeats: int) -> NDArray[np.float64]:
    """Errors of shape (samplers, counts, repeats); every render has a seed of its own."""
    return np.array(
        [
            [[error_of_image(scene, sampler, spp, size, seed) for seed in range(repeats)] for spp in counts]
            for sampler in SAMPLERS
        ]
    )


def draw(counts: list[int], mean: NDArray[np.float64], bar: NDArray[np.float64], path: str) -> None:
    """Plot errors against samples, both in logarithms, and the slope of independent samples."""
    figure = empty_figure(6, 4.5)
    panel = figure.subplots()
    for name, values, bars in zip(SAMPLERS, mean, bar, strict=True):
        panel.errorbar(counts, values, yerr=2 * bars, marker="o", capsize=3, label=name)
    guide = mean[0, 0] * np.sqrt(counts[0] / np.array(counts))
    panel.plot(counts, guide, ":", color="gray", label="slope -1/2")
    panel.set_xscale("log", base=2)
    panel.set_yscale("log")
    panel.set(xlabel="samples per pixel", ylabel="error of a pixel (rms of luminance)")
    panel.legend()
    figure.savefig(path, dpi=120)


def main(arguments: list[str] | None = None) -> int:
    """Measure, print and draw."""
    parser = argparse.ArgumentParser(description="Errors of all samplers on a scene.")
    parser.add_argument("scene", nargs="?", default="scenes/box.xml")
    parser.add_argument("--size", default="64x64", help="pixels (%(default)s)")
    parser.add_argument("--most", type=int, default=256, help="samples per pixel, a power of 2 (%(default)s)")
    parser.add_argument("--repeats", type=int, default=4, help="renders per point of the plot (%(default)s)")
    parser.add_argument("-o", "--output", default="samplers.png")
    options = parser.parse_args(arguments)
    width, height = map(int, options.size.split("x"))
    counts = [4 * 2**k for k in range(0, (options.most // 4).bit_length(), 2)]
    errors = measure(evenlight.load_scene(options.scene), counts, (width, height), options.repeats)
    mean = errors.mean(axis=2)
    bar = errors.std(axis=2, ddof=1) / np.sqrt(options.repeats)
    for name, values, bars in zip(SAMPLERS, mean, bar, strict=True):
        equal = counts[-1] * (mean[0, -1] / values[-1]) ** 2
        print(f"{name:>12}: {values[-1]:.5f} ± {bars[-1]:.5f} at {counts[-1]} spp, as {equal:.0f} independent samples")
    draw(counts, mean, bar, options.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
