"""Prices of options on a geometric Brownian motion, from formulas; the Asian one from Večeř's differential equation."""

__all__ = ["PRICES"]

PRICES = {
    "european": 10.4505835722,
    "asian": 5.76309,
    "lookback": 17.2168022374,
    "barrier": 9.9492703086,
    "digital": 53.2324815454,
}
