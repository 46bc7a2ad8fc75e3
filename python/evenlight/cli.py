"""The command line: `evenlight render | points | integrate | multilevel | info`."""

from __future__ import annotations

import argparse
import json
import math
import signal
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

from tqdm import tqdm

import evenlight
from evenlight import _core, integrands, points, rules, tables
from evenlight.film import Film, check_output
from evenlight.multilevel import debias, level_table, mlmc, mlqmc, models
from evenlight.render import read_scene

__all__ = ["main"]

_LEVEL_METHODS: dict[str, Any] = {"mlmc": mlmc, "mlqmc": mlqmc, "debias": debias}

EXIT_ERROR = 2
EXIT_INTERRUPTED = 130  # 128 + SIGINT, as shells have it


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code: 0, 2 after an error, 130 after Ctrl-C or a request to end."""
    options = _parser().parse_args(arguments)
    previous = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        return int(options.run(options))
    except KeyboardInterrupt:
        print("evenlight: interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED
    except BrokenPipeError:  # the reader of `-o -` has seen enough
        sys.stderr.close()
        return EXIT_ERROR
    except (ValueError, TypeError, OSError, MemoryError) as error:
        print(f"evenlight: error: {_one_line(error)}", file=sys.stderr)
        return EXIT_ERROR
    finally:
        signal.signal(signal.SIGTERM, previous)


def _render(options: argparse.Namespace) -> int:
    for path in options.output:
        check_output(path)
    scene = _load(options)
    with _Bar(options.quiet) as bar:
        film = evenlight.render(
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
    return "unknown" if math.isnan(ratio) else f"{ratio:.2%}"


def _info(options: argparse.Namespace) -> int:
    scene = _load(options)
    print(json.dumps(scene.info(), indent=2, ensure_ascii=False, default=str))
    return 0


def _points(options: argparse.Namespace) -> int:
    if options.dims < 1:
        raise ValueError(f"--dims must be at least 1, not {options.dims}")
    settings = dict(options.option)
    if points.SEQUENCES[options.sequence].finite:
        settings.setdefault("n", options.start + options.count)
    engine = points.build(options.sequence, options.dims, scramble=options.scramble, seed=options.seed, **settings)
    tables.write(options.output, engine, range(options.start, options.start + options.count), options.dims)
    return 0


def _integrate(options: argparse.Namespace) -> int:
    problem = integrands.build(options.integrand, options.dims)
    engine = points.build(options.sequence, options.dims, scramble=options.scramble, seed=options.seed)
    if options.n is None and options.rtol is None and options.atol is None:
        options.n = 2**16
    with _shown_warnings():
        estimate = evenlight.integrate(
            problem,
            engine,
            n=options.n,
            rtol=options.rtol,
            atol=options.atol,
            replicates=options.replicates,
            level=options.level,
            max_n=options.max_n,
            method=options.method,
        )
    low, high = estimate.confidence_interval(options.level)
    known = {"exact": problem.exact, "interval": None if math.isnan(low) else [low, high], "level": options.level}
    if options.json:
        print(json.dumps(estimate.to_dict() | known, indent=2))
    else:
        interval = "" if math.isnan(low) else f", {options.level:.4g} interval [{low:.8g}, {high:.8g}]"
        print(f"{estimate!r}{interval}, exact {problem.exact!r}")
    return 0


def _multilevel(options: argparse.Namespace) -> int:
    plain = [setting for setting in options.setting if not isinstance(setting, tuple)]
    named: dict[str, Any] = dict(setting for setting in options.setting if isinstance(setting, tuple))
    model = models.build(options.model, *plain, **named)
    with _shown_warnings():
        estimate = _LEVEL_METHODS[options.method](model, rmse=options.rmse, seed=options.seed)
    low, high = estimate.confidence_interval(options.level)
    if options.json:
        print(json.dumps(estimate.to_dict() | {"interval": [low, high], "level": options.level}, indent=2))
        return 0
    print(f"{estimate!r}, {options.level:.0%} interval {low:.8g} to {high:.8g}, cost {estimate.cost:.4g}")
    if "levels" in estimate.diagnostics:
        print(level_table(estimate))
    return 0


@contextmanager
def _shown_warnings() -> Iterator[None]:
    """Warnings become lines on standard error."""
    with warnings.catch_warnings(record=True) as raised:
        warnings.simplefilter("always")
        yield
    for warning in raised:
        print(f"evenlight: warning: {warning.message}", file=sys.stderr)


def _load(options: argparse.Namespace) -> evenlight.Scene:
    scene = read_scene(options.scene, dict(options.define), options.lenient, options.allow_outside, options.kernel)
    for warning in scene.warnings:
        print(f"evenlight: warning: {warning}", file=sys.stderr)
    return scene


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


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(EXIT_ERROR, f"evenlight: error: {message} (see {self.prog} --help)\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(prog="evenlight", description="Images whose every pixel carries an honest standard error.")
    parser.add_argument("--version", action="version", version=f"evenlight {evenlight.__version__}")
    commands = parser.add_subparsers(title="commands", required=True, metavar="COMMAND", parser_class=_Parser)
    _add_render(commands.add_parser("render", help="render a scene", description="Render a Mitsuba 3 scene."))
    _add_points(commands.add_parser("points", help="write points", description="Write (randomized) points."))
    _add_integrate(
        commands.add_parser("integrate", help="integrate a test function", description="Integrate a test function.")
    )
    _add_multilevel(
        commands.add_parser("multilevel", help="estimate by levels", description="Estimate a model by its levels.")
    )
    info = commands.add_parser("info", help="say what a scene contains", description="Say what a scene contains.")
    _add_scene(info)
    info.set_defaults(run=_info)
    return parser


def _add_render(parser: argparse.ArgumentParser) -> None:
    _add_scene(parser)
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
    add("--exposure", type=_stops, default=0.0, help="stops by which a PNG is brightened (%(default)s)")
    add("--quiet", action="store_true", help="no progress bar, no summary")
    parser.set_defaults(run=_render)


def _add_scene(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("scene", metavar="SCENE", help="a Mitsuba 3 XML file")
    add(
        "-D",
        "--define",
        action="append",
        type=_definition,
        default=[],
        metavar="NAME=VALUE",
        help="$NAME in it",
    )
    add("--lenient", action="store_true", help="unknown plugins and parameters are warnings")
    add("--allow-outside", action="store_true", help="allow files outside the scene's folder")
    add(
        "--kernel",
        choices=_core.kernels(),
        default="auto",
        help="what intersects rays (%(default)s)",
    )


def _add_points(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    names = [sequence.name for sequence in points.available()]
    add("sequence", choices=names, metavar="SEQUENCE", help=", ".join(names))
    add("--dims", type=int, default=2, help="dimensions (%(default)s)")
    add("--count", type=_natural, default=1024, help="rows (%(default)s)")
    add("--start", type=_natural, default=0, help="index of the first row (%(default)s)")
    add("--scramble", help="how to randomize (the sequence's own default)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add(
        "-O",
        "--option",
        action="append",
        default=[],
        type=_option,
        metavar="NAME=VALUE",
        help="what the sequence asks besides, such as base=3; a list as generator=1,182667",
    )
    add("-o", "--output", default="-", metavar="FILE", help=".npy, .csv, or - for CSV on standard output")
    parser.set_defaults(run=_points)


def _add_integrate(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("integrand", choices=list(integrands.INTEGRANDS), metavar="INTEGRAND", help=", ".join(integrands.INTEGRANDS))
    add("--dims", type=int, default=5, help="dimensions (%(default)s)")
    add("--sequence", choices=list(points.SEQUENCES), default="sobol", help="the points (%(default)s)")
    add("--scramble", help="how to randomize (the sequence's own default)")
    add("--n", type=int, help="function values (65536, unless there is a tolerance)")
    add("--rtol", type=float, help="work up to this relative tolerance")
    add("--atol", type=float, help="work up to this absolute tolerance")
    add("--replicates", type=int, default=16, help="independent randomizations, for the error (%(default)s)")
    add("--level", type=float, default=0.95, help="of the interval and of the tolerance (%(default)s)")
    add("--max-n", type=int, default=2**24, help="the most function values for a tolerance (%(default)s)")
    add("--method", choices=["auto", *rules.RULES], default="auto", help="how values become an estimate (%(default)s)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add("--json", action="store_true", help="print everything as JSON")
    parser.set_defaults(run=_integrate)


def _add_multilevel(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("model", choices=list(models.MODELS), metavar="MODEL", help=", ".join(models.MODELS))
    add("setting", nargs="*", type=_setting, help="what the model asks, such as: asian exact construction=bridge")
    add("--rmse", type=float, required=True, help="root mean squared error to reach, of bias and noise together")
    add("--method", choices=list(_LEVEL_METHODS), default="mlmc", help="above the levels (%(default)s)")
    add("--level", type=float, default=0.95, help="of the interval (%(default)s)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add("--json", action="store_true", help="print everything as JSON")
    parser.set_defaults(run=_multilevel)


def _setting(text: str) -> Any:
    """A word, or a pair of a name and a number or a word."""
    name, equals, value = text.partition("=")
    if not equals:
        return text
    for kind in (int, float):
        try:
            return name, kind(value)
        except ValueError:
            continue
    return name, value


def _natural(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and int(text) < 2**63):
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number from 0 to 2^63 - 1")
    return int(text)


def _stops(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"'{text}' is not a finite number of stops")
    return number


def _size(text: str) -> tuple[int, int]:
    width, cross, height = text.lower().partition("x")
    if not (cross and width.isdecimal() and height.isdecimal() and int(width) and int(height)):
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT, such as 640x360")
    return int(width), int(height)


def _definition(text: str) -> tuple[str, str]:
    name, equals, value = text.partition("=")
    if not (name and equals):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=VALUE")
    return name, value


def _option(text: str) -> tuple[str, int | list[int]]:
    name, equals, value = text.partition("=")
    numbers = value.split(",")
    if not (name.isidentifier() and equals and all(number.isascii() and number.isdecimal() for number in numbers)):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=NUMBER or NAME=NUMBER,NUMBER,…")
    return name, int(value) if len(numbers) == 1 else [int(number) for number in numbers]


def _one_line(error: BaseException) -> str:
    if isinstance(error, OSError) and error.strerror and error.filename:
        return f"{Path(str(error.filename))}: {error.strerror}"
    return " ".join(str(error).split()) or type(error).__name__
