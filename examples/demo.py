"""Render a scene of ours with two samplers at the same number of samples, and say where the pictures are.

Run by `make demo`. Both images cost the same; compare their standard errors, or look at the noise.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

from tqdm import tqdm

import evenlight

ROOT = Path(__file__).resolve().parent.parent
SAMPLERS = ("independent", "sobol")
SPP = 64
REPLICATES = 4


def main() -> int:
    """Render, write and report."""
    folder = ROOT / "out"
    folder.mkdir(exist_ok=True)
    scene = evenlight.load_scene(ROOT / "scenes" / "demo.xml")
    errors = {}
    for sampler in SAMPLERS:
        with tqdm(unit="sample", unit_scale=True, desc=sampler, leave=False, disable=None) as bar:

            def show(state: dict[str, Any], bar: tqdm[Any] = bar) -> None:
                bar.total = state["total"]
                bar.update(state["done"] - bar.n)

            film = evenlight.render(scene, sampler=sampler, spp=SPP, replicates=REPLICATES, progress=show)
        if film.partial:
            return 130
        errors[sampler] = film.relative_error
        for suffix in (".png", ".exr"):
            film.write(folder / f"demo-{sampler}{suffix}")
        print(f"{sampler:>12}: mean relative error {film.relative_error:6.2%} in {film.metadata['seconds']:.1f} s")
        print(f"              out/demo-{sampler}.png to look at, .exr with the standard error of every pixel")
    ratio = (errors["independent"] / errors["sobol"]) ** 2
    print(f"The same error with independent samples would take about {ratio:.1f} times as many.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
