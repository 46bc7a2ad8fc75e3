"""Coupled models: the laws of level samplers on every one of them, refusals, nested expectations, mixed precision."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import stats

from conftest import ROOT
from evenlight.multilevel import models
from evenlight.multilevel.level_sampler import draw
from evenlight.multilevel.models import FORMATS, INDEXED_MODELS, MODELS, MixedPrecision, Option, build
from evenlight.multilevel.models.formats import Arithmetic, as_arithmetic
from level_moments import exponent, moments


def mean_reversion(**settings: Any) -> models.StochasticDifferentialEquation:
    """A path-dependent quantity of an equation with two components and three noises."""

    def diffusion(t: float, x: NDArray[np.float64]) -> NDArray[np.float64]:
        return (
            np.stack([np.stack([x[1], 0.1 * x[0], 0.2 + 0.0 * x[0]]), np.stack([0.3 * x[1], 0.0 * x[0], x[0]])]) * 0.2
        )

    return models.StochasticDifferentialEquation(
        lambda t, x: 1.0 - x, diffusion, [2.0, 1.0], lambda x: x[:, 0].mean(axis=0) ** 2, whole_path=True, **settings
    )


def births_and_deaths(x: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
    return 30.0, x[0]


EXAMPLES: dict[str, list[Any]] = {
    "gbm": [
        *(build("gbm", payoff) for payoff in models.PAYOFFS),
        *(build("gbm", payoff, "euler", construction="bridge") for payoff in models.PAYOFFS),
        build("gbm", "lookback", "exact", construction="pca", first_steps=3),
    ],
    "sde": [mean_reversion(scheme=scheme) for scheme in ("euler", "milstein", "antithetic_milstein")],
    "heston": [build("heston"), build("heston", "euler", construction="pca")],
    "clark_cameron": [build("clark_cameron"), build("clark_cameron", antithetic=False, construction="bridge")],
    "reaction_paths": [
        build("reaction_paths", models.ReactionNetwork([[1], [-1]], births_and_deaths, [5]), exact_level=2)
    ],
    "nested_expectation": [models.partial_information(0.2)[0]],
    "diffusion_1d": [build("diffusion_1d"), build("diffusion_1d", "uniform", first_cells=3)],
    "diffusion_2d": [build("diffusion_2d", first_cells=3), build("diffusion_2d", "uniform", first_cells=2)],
    "mixed_precision": [build("mixed_precision"), build("mixed_precision", ["bfloat16", "significand12", "float64"])],
}
ALL = [model for examples in EXAMPLES.values() for model in examples]
INDEXED = [models.IndexedDiffusion1D("uniform"), models.IndexedDiffusion2D("log_normal", first_cells=2)]


def test_every_model_has_its_file_and_an_example() -> None:
    assert set(EXAMPLES) == set(MODELS)
    assert {type(model) for model in INDEXED} == set(INDEXED_MODELS.values())
    for name, model in MODELS.items():
        assert model.__module__ == f"evenlight.multilevel.models.{name}"
        assert (ROOT / f"python/evenlight/multilevel/models/{name}.py").is_file()
        assert all(isinstance(example, model) for example in EXAMPLES[name])


@pytest.mark.parametrize("model", ALL, ids=lambda model: model.name)
def test_a_row_of_values_depends_on_its_row_of_numbers_alone(model: Any) -> None:
    for level in (0, 1, 2):
        u = np.random.default_rng(level).random((150, model.dims(level)))
        u[0] = 0.0
        whole = draw(model, level, u)
        rows = np.array([140, 0, 7])
        part = draw(model, level, u[rows])
        assert part.fine == pytest.approx(whole.fine[rows], rel=1e-12, abs=1e-12)
        assert part.coarse == pytest.approx(whole.coarse[rows], rel=1e-12, abs=1e-12)
        assert level > 0 or not whole.coarse.any()


@pytest.mark.parametrize("model", ALL, ids=lambda model: model.name)
def test_the_coarse_mean_is_the_fine_mean_of_the_level_below(model: Any) -> None:
    """Independent samples of both; 60 comparisons at 4.5 sigma: a false alarm in 2,500 runs of this test."""
    for level in (1, 2):
        n = 2000 if "diffusion_2d" in model.name or "birth" in model.name else 6000
        rng = np.random.default_rng(10 + level)
        coarse = model.sample(level, rng.random((n, model.dims(level)))).coarse
        fine = model.sample(level - 1, rng.random((n, model.dims(level - 1)))).fine
        assert abs(coarse.mean() - fine.mean()) <= 4.5 * math.hypot(stats.sem(coarse), stats.sem(fine)) + 1e-12


@pytest.mark.parametrize("model", ALL, ids=lambda model: model.name)
def test_costs_are_what_they_are_said_to_be(model: Any) -> None:
    """Costs of exact chains vary, by 3 % for the mean of this many paths; the others are equal."""
    for level in (0, 1, 2):
        u = np.random.default_rng(level).random((300, model.dims(level)))
        assert model.sample(level, u).cost / 300 == pytest.approx(model.cost(level), rel=0.15 if model.keyed else 1e-12)


@pytest.mark.parametrize("model", [model for model in ALL if hasattr(model, "ladder")], ids=lambda model: model.name)
def test_the_last_rungs_of_a_ladder_are_fine_and_coarse(model: Any) -> None:
    u = np.random.default_rng(1).random((30, model.dims(2)))
    if getattr(model, "antithetic", False):
        with pytest.raises(ValueError, match="antithetic: it has no single simulation"):
            model.ladder(2, u)
        return
    rungs, coupled = model.ladder(2, u), model.sample(2, u)
    assert rungs.shape == (30, 3)
    assert rungs[:, 2] == pytest.approx(coupled.fine, rel=1e-12)
    assert rungs[:, 1] == pytest.approx(coupled.coarse, rel=1e-12)


@pytest.mark.parametrize(
    "model", [model for model in ALL + INDEXED if "sde" not in model.name], ids=lambda model: model.name
)
def test_models_travel(model: Any) -> None:
    """Those of functions that have a name, that is: not the lambdas of the equation above."""
    copy = pickle.loads(pickle.dumps(model))
    level = (1, 1) if model in INDEXED else 1
    u = np.random.default_rng(1).random((8, model.dims(level)))
    assert (copy.sample(level, u).fine == model.sample(level, u).fine).all()


@pytest.mark.parametrize("payoff", models.PAYOFFS)
def test_the_first_rung_of_a_long_ladder_has_the_mean_of_the_first_level(payoff: str) -> None:
    """Filled in at eight times as many places; 4.5 sigma each: a false alarm in 30,000 runs."""
    model = build("gbm", payoff, first_steps=2)
    rng = np.random.default_rng(1)
    first = model.ladder(3, rng.random((20000, model.dims(3))))[:, 0]  # type: ignore[attr-defined]
    direct = model.sample(0, rng.random((20000, model.dims(0)))).fine
    assert abs(first.mean() - direct.mean()) <= 4.5 * math.hypot(stats.sem(first), stats.sem(direct))


@pytest.mark.parametrize("model", ALL, ids=lambda model: model.name)
def test_numbers_of_another_shape_are_refused(model: Any) -> None:
    with pytest.raises(ValueError, match=r"u must have shape"):
        model.sample(1, np.zeros((4, model.dims(1) + 1)))
    with pytest.raises(ValueError, match=r"level must be"):
        model.sample(-1, np.zeros((4, model.dims(0))))


def test_settings_are_checked() -> None:
    network = models.ReactionNetwork([[1]], lambda x: (1.0,), [0])
    cases: dict[str, Callable[[], object]] = {
        "unknown model 'x'; known: gbm, sde": lambda: build("x"),
        "unknown payoff 'x'; known: european": lambda: build("gbm", "x"),
        "unknown scheme 'x'; known: euler": lambda: build("gbm", scheme="x"),
        "unknown construction 'x'; known": lambda: build("heston", construction="x"),
        "volatility must be above 0": lambda: build("gbm", volatility=0.0),
        "unknown term 'strke'; known: spot, strike": lambda: build("gbm", strke=90.0),
        "unknown term 'volatility'; known: spot": lambda: build("heston", volatility=0.2),
        "strike must be a finite number, not 'x'": lambda: build("gbm", strike="x"),
        "rate must be a finite number": lambda: build("gbm", rate=math.nan),
        "barrier must be at most spot and strike": lambda: build("gbm", "barrier", barrier=101.0),
        "first_steps must be at least 1": lambda: build("gbm", first_steps=0),
        "correlation must be between": lambda: build("heston", correlation=1.0),
        "horizon must be above 0": lambda: build("clark_cameron", horizon=-1.0),
        "drift must return shape": lambda: build("sde", lambda t, x: np.zeros(3), lambda t, x: x, 1.0, None),
        "diffusion must return shape": lambda: build("sde", lambda t, x: x, lambda t, x: np.zeros(3), 1.0, None),
        "start must be finite numbers": lambda: build("sde", lambda t, x: x, lambda t, x: x, math.nan, None),
        "refinement must be at least 2": lambda: build("reaction_paths", refinement=1),
        "level must be at most 1, where": lambda: build("reaction_paths", exact_level=1).sample(2, np.zeros((1, 2))),
        "changes and start must be whole": lambda: models.ReactionNetwork([[0.5]], lambda x: (1.0,), [0]),
        "changes and start must have shapes": lambda: models.ReactionNetwork([[1]], lambda x: (1.0,), [0, 0]),
        "rates must be 1, one for each": lambda: models.ReactionNetwork([[1]], lambda x: (1.0, 2.0), [0]),
        "quantity must return shape": lambda: build("reaction_paths", network, lambda x: 0.0).sample(
            0, np.zeros((1, 2))
        ),
        "spread and noise must be above 0": lambda: models.partial_information(spread=0.0),
        "unknown field 'x'; known: log_normal": lambda: build("diffusion_2d", "x"),
        "amplitude must be between 0 and 1": lambda: models.UniformField(amplitude=1.0),
        "sigma and length must be above 0": lambda: models.LogNormalField(length=0.0),
        "first_terms must be at most": lambda: models.IndexedDiffusion1D("uniform", first_terms=9),
        "level must be at most": lambda: models.IndexedDiffusion1D("uniform").sample((0, 4), np.zeros((1, 16))),
        "unknown format 'x'; known: bfloat16": lambda: build("mixed_precision", ["x"]),
        "bits must be one of 16, 32, 64": lambda: build("mixed_precision", ["float8"]),
        "bits must be at least 2": lambda: build("mixed_precision", ["fixed1"]),
        "significand must be at most 50": lambda: build("mixed_precision", ["significand51"]),
        "formats must have at least one": lambda: build("mixed_precision", []),
        "costs must be 1 numbers": lambda: build("mixed_precision", ["float16"], costs=[0.0]),
    }
    for message, make in cases.items():
        with pytest.raises(ValueError, match=message):
            make()


def test_the_value_of_information_is_known() -> None:
    """Theory: bias and variance exponents 1 and 3/2; the fit's standard deviation is 0.05."""
    model, exact = models.partial_information(0.3, 1.0, 2.0, first_samples=2)
    n = 2**14
    means, variances = moments(model, 8, n, seed=5)
    assert exact == pytest.approx(0.3 + stats.norm.expect(lambda x: max(-x, 0.0), loc=0.3), abs=1e-6)
    assert abs(means.sum() - exact) <= 4 * math.sqrt(variances.sum() / n) + 2 * abs(means[-1])
    assert exponent(variances) == pytest.approx(1.5, abs=0.2)
    assert np.log2(means[2] / means[6]) / 4 == pytest.approx(1.0, abs=0.2)


def test_smooth_functions_of_inner_means_are_better_still() -> None:
    model = models.NestedExpectation(
        lambda x, y: np.sqrt(3.0) * (2.0 * (x + y) - 1.0), outer_dims=1, inner_dims=1, g=lambda mean: np.sin(mean[:, 0])
    )
    _, variances = moments(model, 7, 2**13, seed=5)
    assert exponent(variances) == pytest.approx(2.0, abs=0.15)


def euler_of_prices(arithmetic: Arithmetic, z: NDArray[np.float64]) -> NDArray[np.float64]:
    """The textbook's form, S + (S r h + S σ ΔW), every operation rounded."""
    h = 1.0 / len(z)
    price = arithmetic.number(np.full(z.shape[1], 100.0))
    drift, volatility = arithmetic.number(0.05 * h), arithmetic.number(0.2)
    for motion in arithmetic.number(z * math.sqrt(h)):
        noise = arithmetic.multiply(arithmetic.multiply(volatility, price), motion)
        price = arithmetic.add(price, arithmetic.add(arithmetic.multiply(price, drift), noise))
    return np.maximum(arithmetic.double(price) - 100.0, 0.0)


def test_two_bits_more_are_sixteen_times_less_variance() -> None:
    """Two forms of the simulation; the published ladder is that of prices. Variances of 2^15 samples err by 2 %."""
    published = {6: 3.8e-2, 8: 2.4e-3, 10: 1.5e-4, 12: 9.5e-6, 16: 3.7e-8}
    names = [f"significand{bits}" for bits in published]
    for simulation in (None, euler_of_prices):
        model = MixedPrecision([*names, "float64"], simulation=simulation, steps=32)
        values = model.ladder(5, np.random.default_rng(3).random((2**15, 32)))
        errors = (values[:, :5] - values[:, 5:]).var(axis=0) / values[:, 5].var()
        assert errors[:3] / errors[1:4] == pytest.approx(16.0, abs=1.0)
        assert errors[3] / errors[4] == pytest.approx(256.0, abs=20.0)
        if simulation is not None:
            assert errors == pytest.approx(list(published.values()), rel=0.06)


def test_the_ladder_ends_at_the_simulation_in_doubles() -> None:
    model = MixedPrecision(steps=8)
    u = np.random.default_rng(1).random((64, 8))
    assert model.sample(5, u).fine == pytest.approx(build("gbm", scheme="euler").sample(3, u).fine, abs=1e-10)
    means, variances = moments(model, 6, 2**14, seed=2)
    exact = build("gbm", scheme="euler").sample(3, np.random.default_rng(8).random((2**17, 8))).fine
    assert abs(means.sum() - exact.mean()) <= 4 * math.hypot(math.sqrt(variances.sum() / 2**14), stats.sem(exact))
    assert (variances[3:] < variances[2:5] / 10).all()


@pytest.mark.parametrize("name", ["bfloat16", "significand11", "significand24", "float16", "float32", "fixed8"])
def test_formats_round_to_the_nearest(name: str) -> None:
    """Of all numbers of a format, none is nearer; sums and products are those of doubles, rounded once."""
    form = as_arithmetic(name)
    rng = np.random.default_rng(1)
    a, b = (form.number(rng.uniform(-0.9, 0.9, 2000)) for _ in range(2))
    for exact, rounded in (
        (form.double(a) + form.double(b), form.double(form.add(a, b))),
        (form.double(a) * form.double(b), form.double(form.multiply(a, b))),
    ):
        if name == "fixed8":
            steps = np.clip(np.round(exact * 128), -128, 127) / 128
        else:
            bits = {"bfloat16": 8, "float16": 11, "float32": 24}.get(name) or int(name.removeprefix("significand"))
            fraction, power = np.frexp(exact)
            steps = np.ldexp(np.round(fraction * 2.0**bits), power - bits)
        small = np.abs(exact) < 2.0**-13  # where half precision has fewer bits
        assert (rounded == steps)[~small | (name != "float16")].all()


def test_costs_can_be_measured() -> None:
    model = MixedPrecision(["fixed4", "float32", "float64"])
    fixed, single, double = model.measured_costs(256)
    assert fixed == 8 * 4 / 64
    assert single > 0.0 and double == pytest.approx(8.0, rel=0.9)
    assert MixedPrecision(["fixed4", "float32"], costs=[1.0, 3.0]).cost(1) == 4.0


def test_every_kind_of_format_is_listed() -> None:
    folder = ROOT / "python/evenlight/multilevel/models/formats"
    members = {kind.__module__.rpartition(".")[2] for kind in FORMATS.values()}
    assert {path.stem for path in folder.glob("*.py")} == members | {"__init__", "arithmetic"}
    assert Option().discount == pytest.approx(math.exp(-0.05))
