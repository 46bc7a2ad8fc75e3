"""Every public name says what it is and shows an example (which runs as a test)."""

from __future__ import annotations

import inspect

import pytest

import evenlight
from evenlight import (
    blue_noise,
    domains,
    importance,
    integrands,
    lab,
    mcmc,
    multilevel,
    points,
    quality,
    reduction,
    smc,
)
from evenlight.multilevel import models


def public_names() -> list[tuple[str, object]]:
    """All classes and functions a user is meant to see."""
    modules = {
        "evenlight": evenlight,
        "evenlight.points": points,
        "evenlight.blue_noise": blue_noise,
        "evenlight.domains": domains,
        "evenlight.reduction": reduction,
        "evenlight.integrands": integrands,
        "evenlight.quality": quality,
        "evenlight.importance": importance,
        "evenlight.lab": lab,
        "evenlight.mcmc": mcmc,
        "evenlight.multilevel": multilevel,
        "evenlight.smc": smc,
        "evenlight.multilevel.models": models,
    }
    return [
        (f"{prefix}.{name}", thing)
        for prefix, module in modules.items()
        for name in module.__all__
        for thing in [getattr(module, name)]
        if inspect.isclass(thing) or inspect.isfunction(thing)
    ]


@pytest.mark.parametrize(("name", "thing"), public_names())
def test_public_names_are_documented_with_an_example(name: str, thing: object) -> None:
    document = inspect.getdoc(thing) or ""
    assert document, name
    shown_by_others = inspect.isclass(thing) and (
        issubclass(thing, (tuple, integrands.Problem, importance.Density, lab.MixtureProblem, lab.RateCase))
        or thing.__subclasses__()
    )
    if not shown_by_others:
        assert ">>>" in document, f"{name} has no example"


@pytest.mark.parametrize(("name", "thing"), public_names())
def test_public_methods_are_documented(name: str, thing: object) -> None:
    for attribute, member in inspect.getmembers(thing):
        if not attribute.startswith("_") and (inspect.isfunction(member) or isinstance(member, property)):
            assert inspect.getdoc(member), f"{name}.{attribute}"
