"""`make validate`: every shared scene that has a reference, rendered and held against it.

The references come from an independent renderer. An image passes when at most half a point more blocks are far from
the reference than Mitsuba's own renders of the same size show (mitsuba_calibration.csv), and when its mean is within
0.5 % plus three standard errors. Writes benches/VALIDATION.md and side-by-side pictures into out/validate/.
"""

from __future__ import annotations

import argparse
import csv
import os
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import evenlight
from benches.blocks import SIDE, Comparison, compare, pool
from benches.machine import describe
from evenlight import _core

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
POSTPONED = {"volumetric-caustic"}  # participating media are not there yet: no failure until they are
ALLOWED_BEYOND = 0.005  # above the yardstick
ALLOWED_DIFFERENCE = 0.005  # beside three standard errors


@dataclass(frozen=True)
class Verdict:
    """One line of the report: a comparison with its yardstick, or why there is none."""

    scene: str
    comparison: Comparison | None = None
    worst: float = 0.0
    yardstick: float = 0.0
    seconds: float = 0.0
    message: str = ""

    @property
    def passed(self) -> bool:
        """Whether the image agrees with its reference."""
        if self.comparison is None:
            return False
        allowed = ALLOWED_DIFFERENCE + 3 * self.comparison.difference_error
        return self.comparison.beyond <= self.yardstick + ALLOWED_BEYOND and (
            abs(self.comparison.difference) <= allowed
        )


def scene_folder() -> Path:
    """Where the shared scenes are."""
    return Path(os.environ.get("EVENLIGHT_SCENES", ROOT.parent / "shared" / "scenes"))


def yardsticks() -> dict[str, float]:
    """What fraction of blocks Mitsuba itself shows beyond 4 sigma, by scene."""
    lines = (HERE / "mitsuba_calibration.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return {row["scene"]: float(row["beyond"]) for row in rows}


def validate(folder: Path, options: argparse.Namespace) -> Verdict:
    """Render one scene and compare it with its reference."""
    name = folder.name
    with np.load(folder / "reference.npz") as archive:
        reference, reference_error = archive["mean"], archive["standard_error"]
    height, width, _ = reference.shape
    start = time.perf_counter()
    comparisons = []
    for seed in range(options.seeds):
        try:
            film = evenlight.render(
                folder / "scene.xml",
                sampler=options.sampler,
                spp=options.spp,
                replicates=options.replicates,
                seed=seed,
                filter="box",
                size=(width, height),
            )
        except (ValueError, OSError) as error:
            return Verdict(name, message=str(error).replace(str(folder) + os.sep, ""))
        if film.partial:
            raise KeyboardInterrupt
        comparisons.append(compare(film.replicates, reference, reference_error))
    seconds = time.perf_counter() - start
    write_picture(options.pictures / f"{name}.png", film.color, reference, comparisons[-1])
    worst = max(found.beyond for found in comparisons)
    # A scene without a yardstick of its own is held to what a perfect renderer would need: nothing beyond.
    return Verdict(name, pool(comparisons), worst, yardsticks().get(name, 0.0), seconds)


def write_picture(
    path: Path, ours: NDArray[np.float32], reference: NDArray[np.float32], comparison: Comparison
) -> None:
    """Ours, the reference, and the deviations of the blocks (gray 0, white +8 sigma, black -8 sigma), side by side."""
    height, width, _ = ours.shape
    exposure = 0.18 / max(float(reference.mean()), 1e-9)
    gray = np.clip(0.5 + comparison.deviations.mean(axis=2, keepdims=True) / 16, 0, 1) ** 2.2
    blocks = np.repeat(np.repeat(gray, SIDE, axis=0), SIDE, axis=1)
    panel = np.zeros((height, width, 3))
    panel[: blocks.shape[0], : blocks.shape[1]] = blocks
    strip = np.concatenate([ours * exposure, reference * exposure, panel], axis=1).astype(np.float32)
    _core.write_png(str(path), np.ascontiguousarray(strip), 0.0, {"panels": "evenlight, reference, deviations"})


def to_markdown(verdicts: Sequence[Verdict], machine: dict[str, str], options: argparse.Namespace) -> str:
    """The report."""
    spp, replicates, seeds = options.spp, options.replicates, options.seeds
    lines = [
        "# Validation",
        "",
        f"Written by `make validate`: {spp} samples per pixel in {replicates} replicates against the references of an "
        f"independent renderer, which carry errors too. Means over {seeds} seeds: under Student's t with "
        f"{replicates - 1} degrees of freedom and rare bright paths, the share of far blocks of one render is noisy; "
        "*worst* is the largest of them.",
        "",
        "*Beyond*: share of 8 × 8 blocks (each channel) more than 4 combined standard errors away, with a floor of "
        f"0.2 %; at most {ALLOWED_BEYOND} above *yardstick*, what Mitsuba's own renders show against the same "
        f"references. *Difference*: of the image means; at most {ALLOWED_DIFFERENCE:.1%} plus three standard errors.",
        "",
        "; ".join(f"{key}: {value}" for key, value in machine.items()),
        "",
        "| scene | beyond | worst | yardstick | difference | seconds | verdict |",
        "|---|---|---|---|---|---|---|",
    ]
    for verdict in verdicts:
        found = verdict.comparison
        if found is None:
            lines.append(f"| {verdict.scene} | – | – | – | – | – | not rendered: {verdict.message} |")
            continue
        lines.append(
            f"| {verdict.scene} | {found.beyond:.4f} | {verdict.worst:.4f} | {verdict.yardstick:.4f} | "
            f"{found.difference:+.4f} ± {found.difference_error:.4f} | {verdict.seconds:.0f} | "
            f"{'passed' if verdict.passed else '**failed**'} |"
        )
    return "\n".join(lines) + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Validate all scenes, or those named."""
    parser = argparse.ArgumentParser(prog="python -m benches.validate", description=__doc__)
    parser.add_argument("scenes", nargs="*", help="names of scenes (all that have a reference)")
    parser.add_argument("--sampler", default="sobol")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--replicates", type=int, default=8)
    parser.add_argument("--seeds", type=int, default=4, help="renders of each scene: seeds 0, 1, …")
    parser.add_argument("--pictures", type=Path, default=ROOT / "out" / "validate")
    parser.add_argument("--report", type=Path, default=HERE / "VALIDATION.md")
    options = parser.parse_args(arguments)
    options.pictures.mkdir(parents=True, exist_ok=True)
    folders = sorted(path.parent for path in scene_folder().glob("*/reference.npz"))
    folders = [folder for folder in folders if not options.scenes or folder.name in options.scenes]
    if not folders:
        parser.error("no scene with a reference.npz; set EVENLIGHT_SCENES to their folder")
    verdicts = []
    for folder in folders:
        verdicts.append(validate(folder, options))
        print(to_markdown(verdicts[-1:], {}, options).splitlines()[-1], flush=True)
    options.report.write_text(to_markdown(verdicts, describe(), options))
    judged = [verdict for verdict in verdicts if verdict.comparison or verdict.scene not in POSTPONED]
    return 0 if all(verdict.passed for verdict in judged) else 1


if __name__ == "__main__":
    sys.exit(main())
