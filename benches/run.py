"""`make bench`: evenlight against Mitsuba 3 and SciPy, in one run on this machine.

Every run is a process of its own; rivals take turns, so that a busy minute hits all alike; figures are medians.
Raw records go to out/bench.json, the tables to benches/RESULTS.md.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benches import errors
from benches.machine import describe, find_llvm
from benches.report import to_markdown
from benches.validate import scene_folder

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
Record = dict[str, Any]

COVERAGE_SPP = (64, 128, 256, 512)  # in 8 replicates: 8 to 64 samples each
MAIN_SCENES = ("cornell-box", "living-room", "dining-room", "classroom")
SCALAR = {"engine": "mitsuba", "variant": "scalar_rgb", "sampler": "independent"}
LLVM = {"engine": "mitsuba", "variant": "llvm_ad_rgb", "sampler": "independent"}
CONTESTANTS: dict[str, Record] = {
    "evenlight sobol": {"engine": "evenlight", "sampler": "sobol"},
    "evenlight independent": {"engine": "evenlight", "sampler": "independent"},
    "mitsuba llvm_ad_rgb": LLVM,
    "mitsuba scalar_rgb": SCALAR,
}
POINT_CASES = ((2, 1 << 20), (8, 1 << 20), (64, 1 << 17))
# Sampler, and which of the engines has it; at 64 samples per pixel, each with four seeds.
ERROR_CASES: dict[str, Record] = {
    "evenlight sobol": {"engine": "evenlight", "sampler": "sobol"},
    "evenlight halton": {"engine": "evenlight", "sampler": "halton"},
    "evenlight independent": {"engine": "evenlight", "sampler": "independent"},
    **{
        f"mitsuba {sampler}": {"engine": "mitsuba", "sampler": sampler}
        for sampler in ("independent", "multijitter", "ldsampler", "orthogonal")
    },
}


def work(task: Record) -> Record:
    """Do one task in a process of its own; a failure is a record too."""
    command = [sys.executable, "-m", "benches.work", json.dumps(task)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["no message"]
        return {"failed": lines[-1].replace(str(scene_folder()) + os.sep, "")}
    record: Record = json.loads(done.stdout.splitlines()[-1])
    return record


def contestants() -> dict[str, Record]:
    """Who runs here: Mitsuba's vectorized variants need an LLVM library."""
    return {name: task for name, task in CONTESTANTS.items() if find_llvm() or task is not LLVM}


def size_of(folder: Path, width: int) -> tuple[int, int]:
    """Width and height in the proportions of the reference."""
    with np.load(folder / "reference.npz") as archive:
        height, reference_width, _ = archive["mean"].shape
    return width, round(width * height / reference_width)


def measure_speed(folder: Path, options: argparse.Namespace) -> Record:
    """Every contestant on one scene, in turns."""
    runs: dict[str, list[Record]] = {name: [] for name in contestants()}
    task = {"kind": "render", "scene": str(folder / "scene.xml"), "size": size_of(folder, options.width)}
    for turn in range(options.rounds):
        for name, contestant in contestants().items():
            runs[name].append(work(task | contestant | {"spp": options.spp, "seeds": [turn + 1]}))
            say(f"{folder.name}, {name}", runs[name][-1])
    return {"scene": folder.name, "runs": runs}


def measure_points(options: argparse.Namespace) -> list[Record]:
    """Sobol' points against SciPy."""
    records = []
    for dims, count in POINT_CASES:
        task = {"kind": "points", "dims": dims, "count": count, "repeats": 2 * options.rounds + 1}
        records.append(task | work(task))
        say(f"{dims} dimensions", records[-1])
    return records


def measure_errors(folder: Path, options: argparse.Namespace) -> Record:
    """Mean squared errors at 64 samples per pixel, and how often 95 % intervals hold the truth."""
    with np.load(folder / "reference.npz") as archive:
        theirs = errors.Reference(archive["mean"], archive["standard_error"], int(archive["batches"]))
    size = [theirs.mean.shape[1], theirs.mean.shape[0]]
    task = {"kind": "render", "scene": str(folder / "scene.xml"), "size": size, "spp": 64, "warm": False}
    variant = "llvm_ad_rgb" if find_llvm() else "scalar_rgb"

    with tempfile.TemporaryDirectory() as scratch:
        save = str(Path(scratch) / "images.npy")

        def images(changes: Record) -> tuple[Record, Any]:
            record = work(task | {"variant": variant, "save": save} | changes)
            return record, (None if "failed" in record else np.load(save))

        replicated = {"engine": "evenlight", "sampler": "sobol", "keep_replicates": True}
        record, stack = images(replicated | {"spp": options.reference_spp, "replicates": 16, "seeds": [7777]})
        if stack is None:
            return record
        ours = errors.Reference.from_replicates(stack[0])
        squares: Record = {}
        for name, case in ERROR_CASES.items():
            record, stack = images(case | {"seeds": [1, 2, 3, 4]})
            squares[name] = record if stack is None else errors.mean_squares(stack, ours, theirs)
            squares[name]["spp"] = record.get("spp")
            say(name, squares[name])
        coverage: Record = {}
        for spp in COVERAGE_SPP:
            record, stack = images(replicated | {"spp": spp, "replicates": 8, "seeds": [1, 2, 3, 4]})
            coverage[str(spp)] = record if stack is None else errors.coverage(stack, ours, theirs)
            say(f"coverage at {spp} spp", coverage[str(spp)])
    return {"scene": folder.name, "reference_spp": options.reference_spp, "squares": squares, "coverage": coverage}


def say(what: str, record: Record) -> None:
    """One line on standard error, so that a long run shows that it lives."""
    if "cpu" in record:
        print(f"{what}: {record['samples'] / record['cpu'] / 1e6:.3f} M samples per CPU-second", file=sys.stderr)
    else:
        print(f"{what}: {json.dumps(record)}", file=sys.stderr)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, keep the record, write the tables."""
    parser = argparse.ArgumentParser(prog="python -m benches.run", description=__doc__)
    parser.add_argument("scenes", nargs="*", help=f"names of scenes ({', '.join(MAIN_SCENES)})")
    parser.add_argument("--all", action="store_true", help="every shared scene that has a reference")
    parser.add_argument("--width", type=int, default=256)
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--reference-spp", type=int, default=4096)
    parser.add_argument("--only", choices=["speed", "points", "errors"], help="measure one thing, keep the others")
    parser.add_argument("--report", type=Path, default=HERE / "RESULTS.md")
    options = parser.parse_args(arguments)
    folders = {path.parent.name: path.parent for path in sorted(scene_folder().glob("*/reference.npz"))}
    if options.only != "points" and not folders:
        parser.error("no scene with a reference.npz; set EVENLIGHT_SCENES to their folder")
    names = options.scenes or (list(folders) if options.all else MAIN_SCENES)

    raw = ROOT / "out" / "bench.json"
    raw.parent.mkdir(exist_ok=True)
    record: Record = json.loads(raw.read_text()) if options.only and raw.exists() else {}
    record |= {"machine": describe(), "width": options.width, "spp": options.spp, "rounds": options.rounds}
    if options.only in (None, "points"):
        record["points"] = measure_points(options)
    if options.only in (None, "errors") and "cornell-box" in folders:
        record["errors"] = measure_errors(folders["cornell-box"], options)
    if options.only in (None, "speed"):
        record["speed"] = [measure_speed(folders[name], options) for name in names if name in folders]
    raw.write_text(json.dumps(record, indent=1))
    options.report.write_text(to_markdown(record))
    print(options.report.read_text())
    return 0


if __name__ == "__main__":
    sys.exit(main())
