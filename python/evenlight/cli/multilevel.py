"""`evenlight multilevel`: the mean of a coupled model, by its levels."""

from __future__ import annotations

import argparse
import json
from typing import Any

from evenlight.cli.warning_lines import warnings_as_lines
from evenlight.multilevel import debias, level_table, mlmc, mlqmc, models, multi_index

__all__ = ["add_arguments", "run"]

_METHODS: dict[str, Any] = {"mlmc": mlmc, "mlqmc": mlqmc, "multi_index": multi_index, "debias": debias}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add = parser.add_argument
    add("model", choices=list(models.MODELS), metavar="MODEL", help=", ".join(models.MODELS))
    add("setting", nargs="*", type=_setting, help="what the model asks, such as: asian exact construction=bridge")
    add("--rmse", type=float, required=True, help="root mean squared error to reach, of bias and noise together")
    add("--method", choices=list(_METHODS), default="mlmc", help="above the levels (%(default)s)")
    add("--level", type=float, default=0.95, help="of the interval (%(default)s)")
    add("--seed", type=int, default=0, help="same seed, same bits (%(default)s)")
    add("--json", action="store_true", help="print everything as JSON")


def run(options: argparse.Namespace) -> int:
    """Estimate and print the levels."""
    plain = [setting for setting in options.setting if not isinstance(setting, tuple)]
    named: dict[str, Any] = dict(setting for setting in options.setting if isinstance(setting, tuple))
    build = _indexed if options.method == "multi_index" else models.build
    model = build(options.model, *plain, **named)
    with warnings_as_lines():
        estimate = _METHODS[options.method](model, rmse=options.rmse, seed=options.seed)
    low, high = estimate.confidence_interval(options.level)
    if options.json:
        print(json.dumps(estimate.to_dict() | {"interval": [low, high], "level": options.level}, indent=2))
        return 0
    print(f"{estimate!r}, {options.level:.4g} interval [{low:.8g}, {high:.8g}], cost {estimate.cost:.4g}")
    if "levels" in estimate.diagnostics:
        print(level_table(estimate))
    return 0


def _indexed(name: str, *arguments: Any, **settings: Any) -> Any:
    """A model with two directions of refinement."""
    if name not in models.INDEXED_MODELS:
        raise ValueError(
            f"{name!r} is refined in one direction only; multi_index takes {', '.join(models.INDEXED_MODELS)}"
        )
    return models.INDEXED_MODELS[name](*arguments, **settings)


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
