"""`evenlight render`: a scene to images with errors, with a progress bar."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from tqdm import tqdm

from evenlight import _core
from evenlight.cli.exit_codes import EXIT_INTERRUPTED
from evenlight.cli.scene_arguments import add_scene, load
from evenlight.film import Film, check_output
from evenlight.rendering import render

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_scene(parser)
    add = parser.add_argument
    add(
        "-o",
        "--output",
        action="append",
        required=True,
        metavar="FILE",
        help=".exr, .png or .npz; repeatable",
    )
    add(
        "--integrator",
        choices=_core.integrators(),
        default="path",
        help="how light paths are made (%(default)s)",
    )
    add("--sampler", choices=_core.samplers(), default="sobol", help="the points behind them (%(default)s)")
    add("--spp", type=int, default=64, help="samples per pixel over all replicates (%(default)s)")
    add("--replicates", type=int, default=4, help="independent randomizations, for the error (%(default)s)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add("--threads", type=int, help="worker threads (all cores)")
    add("--max-depth", type=int, help="longest path in segments; -1: no limit (as the scene says)")
    add("--size", type=_size, metavar="WxH", help="pixels (as the scene says)")
    add("--filter", choices=_core.filters(), help="pixel filter (as the scene says)")
    add("--mis", choices=_core.heuristics(), default="power", help="weighting heuristic (%(default)s)")
    add(
        "--roulette",
        type=_roulette,
        default="throughput",
        metavar="throughput|none|P,P,…",
        help="which paths end by chance; P: survival probabilities from surface to surface (%(default)s)",
    )
    add("--exposure", type=_stops, default=0.0, help="stops by which a PNG is brightened (%(default)s)")
    add("--quiet", action="store_true", help="no progress bar, no summary")


def run(options: argparse.Namespace) -> int:
    """Render the scene and write every output."""
    for path in options.output:
        check_output(path)
    scene = load(options)
    with _Bar(options.quiet) as bar:
        film = render(
            scene,
            integrator=options.integrator,
            sampler=options.sampler,
            spp=options.spp,
            replicates=options.replicates,
            seed=options.seed,
            threads=options.threads,
            max_depth=options.max_depth,
            filter=options.filter,
            size=options.size,
            mis=options.mis,
            roulette=options.roulette,
            progress=bar.show,
        )
    for path in options.output:
        film.write(path, exposure=options.exposure)
    if not options.quiet:
        _say_what_was_written(film, options.output)
    return EXIT_INTERRUPTED if film.partial else 0


def _say_what_was_written(film: Film, paths: Sequence[str]) -> None:
    height, width, _ = film.color.shape
    seconds = film.metadata.get("seconds", float("nan"))
    state = "interrupted: partial image" if film.partial else "done"
    error = f"mean relative error {_percentage(film.relative_error)}"
    print(f"{state}, {width}x{height}, {seconds:.1f} s, {error}: {', '.join(paths)}", file=sys.stderr)


def _percentage(ratio: float) -> str:
    return "unknown (it takes 2 replicates)" if math.isnan(ratio) else f"{ratio:.2%}"


class _Bar:
    """A progress bar with the time left, samples per second and the current mean relative error."""

    def __init__(self, quiet: bool) -> None:
        self._quiet = quiet
        self._bar: tqdm[NoReturn] | None = None

    def __enter__(self) -> _Bar:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.close()

    def show(self, state: dict[str, Any]) -> None:
        """Draw what the renderer says: samples `done` and `total`, and the `relative_error` so far, if known."""
        if self._bar is None:  # not before there is something to show, so that errors stand alone
            self._bar = tqdm(
                total=state["total"],
                unit="sample",
                unit_scale=True,
                dynamic_ncols=True,
                leave=False,
                disable=True if self._quiet else None,  # None: where nobody watches, nothing is drawn
            )
        if state["relative_error"] is not None:
            self._bar.set_postfix_str(f"error {state['relative_error']:.2%}", refresh=False)
        self._bar.update(state["done"] - self._bar.n)


def _stops(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"'{text}' is not a finite number of stops")
    return number


def _roulette(text: str) -> str | list[float]:
    if text in ("throughput", "none"):
        return text
    try:
        return [float(probability) for probability in text.split(",")]
    except ValueError:
        message = f"'{text}' is not throughput, none or probabilities, such as 1,0.9,0.5"
        raise argparse.ArgumentTypeError(message) from None


def _size(text: str) -> tuple[int, int]:
    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdecimal() and height.isdecimal() and int(width) and int(height)):
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT, such as 640x360")
    return int(width), int(height)
