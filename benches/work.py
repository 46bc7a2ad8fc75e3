"""One measured piece of work in a process of its own: a task in (JSON), a record out (JSON, last line).

usage: python -m benches.work '{"kind": "render", "engine": "evenlight", …}'

A process each, because peak memory is that of a process and because a warm JIT of one run must not help the next.
"""

from __future__ import annotations

import json
import os
import re
import resource
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benches.machine import find_llvm

Record = dict[str, Any]
Render = Callable[[int], tuple[NDArray[np.float32], int]]  # seed -> image, samples per pixel taken


def evenlight_renderer(task: Record) -> tuple[Render, str]:
    """Ours: the scene is loaded, and a function renders it."""
    import evenlight

    scene = evenlight.load_scene(task["scene"], kernel=task.get("kernel", "auto"))
    size = tuple(task["size"])

    def render(seed: int) -> tuple[NDArray[np.float32], int]:
        film = evenlight.render(
            scene,
            sampler=task["sampler"],
            spp=task["spp"],
            replicates=task.get("replicates", 1),
            seed=seed,
            filter="box",
            size=(size[0], size[1]),
        )
        return (film.replicates if task.get("keep_replicates") else film.color), task["spp"]

    return render, evenlight.__version__


def mitsuba_renderer(task: Record) -> tuple[Render, str]:
    """The same scene, size, depth and box filter in Mitsuba 3."""
    library = find_llvm()
    if library is not None:
        os.environ["DRJIT_LIBLLVM_PATH"] = library
    import mitsuba as mi

    mi.set_variant(task["variant"])
    mi.set_log_level(mi.LogLevel.Error)
    path = Path(task["scene"])
    text = re.sub(r'<rfilter type="\w+"\s*/>', '<rfilter type="box"/>', path.read_text())
    text = re.sub(r'<sampler type="\w+">', f'<sampler type="{task["sampler"]}">', text)
    os.chdir(path.parent)  # relative files are looked for here
    width, height = task["size"]
    scene = mi.load_string(text, resx=width, resy=height)
    sampler = scene.sensors()[0].sampler()
    sampler.set_sample_count(task["spp"])
    taken = sampler.sample_count()  # some samplers silently round up

    def render(seed: int) -> tuple[NDArray[np.float32], int]:
        image = np.array(mi.render(scene, spp=task["spp"], seed=seed))[..., :3]
        return image.astype(np.float32), taken

    return render, str(mi.__version__)


def run_render(task: Record) -> Record:
    """Load, warm up, render once per seed; the clocks run during the latter alone."""
    start = time.perf_counter()
    render, version = (evenlight_renderer if task["engine"] == "evenlight" else mitsuba_renderer)(task)
    loading = time.perf_counter() - start
    if task.get("warm", True):
        render(999)  # compiles kernels, fills caches, starts threads
    wall, cpu = time.perf_counter(), time.process_time()
    images = []
    taken = 0
    for seed in task["seeds"]:
        image, taken = render(seed)
        images.append(image)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    samples = taken * task["size"][0] * task["size"][1] * len(images)
    if "save" in task:
        np.save(task["save"], np.stack(images))
    return {"wall": wall, "cpu": cpu, "samples": samples, "spp": taken, "loading": loading, "version": version}


def run_points(task: Record) -> Record:
    """Coordinates per second of Sobol' points, ours and SciPy's in turns; the medians."""
    import scipy
    from scipy.stats import qmc

    from evenlight import points

    count, dims = task["count"], task["dims"]
    ours = points.Sobol(dims, scramble="owen", seed=1)
    rates: dict[str, list[float]] = {"evenlight": [], "scipy": []}
    for repeat in range(task["repeats"]):
        theirs = qmc.Sobol(dims, scramble=True, rng=repeat)
        start = time.process_time()
        ours.points(0, count)
        middle = time.process_time()
        theirs.random(count)
        rates["evenlight"].append(count * dims / (middle - start))
        rates["scipy"].append(count * dims / (time.process_time() - middle))
    medians = {name: float(np.median(values)) for name, values in rates.items()}
    return {"rates": medians, "version": scipy.__version__}


def main() -> int:
    """Do the task of the first argument."""
    task: Record = json.loads(sys.argv[1])
    record = {"render": run_render, "points": run_points}[task["kind"]](task)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    record["peak_bytes"] = peak if sys.platform == "darwin" else peak * 1024
    print(json.dumps(record))
    return 0


if __name__ == "__main__":
    sys.exit(main())
