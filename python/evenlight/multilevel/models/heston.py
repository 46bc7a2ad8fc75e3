"""Heston's model of stochastic volatility: correlated noises that do not commute; its price by Fourier inversion."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import SupportsIndex

import numpy as np
from numpy.typing import NDArray
from scipy import integrate

from .path_sampler import PathSampler
from .terms import terms_of

__all__ = ["Heston", "HestonTerms", "heston_call"]

Array = NDArray[np.float64]

_SCHEMES = ("antithetic_milstein", "milstein", "euler")


@dataclass(frozen=True)
class HestonTerms:
    """A European call on dS = r S dt + √V S dW_1, dV = κ (θ - V) dt + ξ √V dW_2, dW_1 dW_2 = ρ dt.

    Examples
    --------
    >>> from evenlight.multilevel.models import HestonTerms
    >>> HestonTerms(correlation=0.0).mean_variance
    0.04
    """

    spot: float = 1.0
    strike: float = 1.0
    rate: float = 0.05
    variance: float = 0.04
    """V at the start."""
    mean_variance: float = 0.04
    """θ."""
    reversion: float = 5.0
    """κ, per year."""
    spread: float = 0.25
    """ξ, the volatility of the variance."""
    correlation: float = -0.5
    """ρ."""
    horizon: float = 1.0
    """Years."""

    def __post_init__(self) -> None:
        for name in ("spot", "strike", "variance", "mean_variance", "reversion", "spread", "horizon"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise ValueError(f"{name} must be above 0 and finite, not {getattr(self, name)}")
        if not -1.0 < self.correlation < 1.0:
            raise ValueError(f"correlation must be between -1 and 1, not {self.correlation}")


def heston_call(terms: HestonTerms) -> float:
    """The price by S. L. Heston, Rev. Financ. Stud. 6(2), 327-343 (1993), to about 1e-10 of the spot.

    The characteristic function is in the form without a branch cut of H. Albrecher, P. Mayer, W. Schoutens and J.
    Tistaert, "The little Heston trap", Wilmott (Jan. 2007), 83-92.

    Examples
    --------
    >>> from evenlight.multilevel.models import HestonTerms, heston_call
    >>> round(heston_call(HestonTerms()), 10)
    0.1045967166
    """
    forward = terms.spot * math.exp(terms.rate * terms.horizon)

    def tail(shift: complex, scale: float) -> float:
        def integrand(w: float) -> float:
            turn = cmath.exp(-1j * w * math.log(terms.strike)) / (1j * w)
            return float((turn * _characteristic(terms, w + shift) / scale).real)

        return 0.5 + integrate.quad(integrand, 0.0, math.inf, epsabs=1e-12, epsrel=1e-12, limit=500)[0] / math.pi

    discount = math.exp(-terms.rate * terms.horizon)
    return terms.spot * tail(-1j, forward) - terms.strike * discount * tail(0.0, 1.0)


def _characteristic(terms: HestonTerms, w: complex) -> complex:
    """E exp(i w log S_T)."""
    variance = terms.spread**2
    pull = terms.reversion - terms.correlation * terms.spread * 1j * w
    root = cmath.sqrt(pull**2 + variance * (1j * w + w**2))
    ratio = (pull - root) / (pull + root)
    decay = cmath.exp(-root * terms.horizon)
    level = (pull - root) * terms.horizon - 2.0 * cmath.log((1.0 - ratio * decay) / (1.0 - ratio))
    constant = terms.reversion * terms.mean_variance / variance * level
    slope = (pull - root) / variance * (1.0 - decay) / (1.0 - ratio * decay)
    return cmath.exp(1j * w * (math.log(terms.spot) + terms.rate * terms.horizon) + constant + slope * terms.variance)


class Heston(PathSampler):
    """A European call in Heston's model; level l has 2^l times the time steps of level 0.

    Parameters
    ----------
    scheme : {"antithetic_milstein", "milstein", "euler"}
        Variances of level differences fall by 4 or more with the first and by 2 with the others, since the noises do
        not commute.
    construction : {"incremental", "bridge", "pca"}
        How uniform numbers become Brownian motion.
    first_steps : int
        Time steps on level 0: best not fewer than the variance's reversion times the horizon.
    **terms
        See `HestonTerms`.

    Raises
    ------
    ValueError
        If a name is unknown or a term impossible.

    Notes
    -----
    The state is (log S, V). Reversion of the variance is exact (integrating factor: M. B. Giles, Oper. Res. 56(3),
    607-617, 2008, section 5), so that large steps are stable; noise sees negative variances as 0. Cost: one unit per
    time step, of any path. References: see `heston_call`, `PathSampler`.

    Examples
    --------
    >>> import numpy as np
    >>> from evenlight.multilevel.models import Heston
    >>> model = Heston(spread=0.2)
    >>> coupled = model.sample(5, np.random.default_rng(1).random((2000, model.dims(5))))
    >>> bool(coupled.difference.std() < coupled.fine.std() / 50)
    True
    """

    def __init__(
        self,
        scheme: str = "antithetic_milstein",
        *,
        construction: str = "incremental",
        first_steps: SupportsIndex = 4,
        **terms: float,
    ) -> None:
        if scheme not in _SCHEMES:
            raise ValueError(f"unknown scheme {scheme!r}; known: {', '.join(_SCHEMES)}")
        self.terms = terms_of(HestonTerms, terms)
        self.name = f"heston {scheme}"
        self._corrected = scheme != "euler"
        super().__init__(
            [math.log(self.terms.spot), self.terms.variance],
            2,
            horizon=self.terms.horizon,
            antithetic=scheme == "antithetic_milstein",
            construction=construction,
            first_steps=first_steps,
        )

    @property
    def known_value(self) -> float:
        """The price, by Fourier inversion."""
        return heston_call(self.terms)

    def step(self, t: float, x: Array, dw: Array, h: float) -> Array:
        """Euler's step, and for Milstein's what is left of its correction without Lévy areas: constant coefficients."""
        terms = self.terms
        variance = np.maximum(x[1], 0.0)
        root = np.sqrt(variance)
        price, other = dw
        own = terms.correlation * price + math.sqrt(1.0 - terms.correlation**2) * other
        y = np.empty_like(x)
        y[0] = x[0] + (terms.rate - 0.5 * variance) * h + root * price
        y[1] = x[1] - terms.mean_variance + terms.spread * root * own
        if self._corrected:
            y[0] += 0.25 * terms.spread * (price * own - terms.correlation * h)
            y[1] += 0.25 * terms.spread**2 * (own * own - h)
        y[1] *= math.exp(-terms.reversion * h)
        y[1] += terms.mean_variance
        return y

    def payoff(self, x: Array) -> Array:
        """Discounted (S_T - K)^+."""
        terms = self.terms
        return np.asarray(np.maximum(np.exp(x[0]) - terms.strike, 0.0) * math.exp(-terms.rate * terms.horizon))
