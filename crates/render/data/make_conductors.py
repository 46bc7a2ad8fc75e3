#!/usr/bin/env python3
"""Integrate measured indices of refraction to linear sRGB and write `conductors.csv`.

Usage: make_conductors.py FOLDER
       FOLDER holds `<material>.eta.spd` and `<material>.k.spd`, as Mitsuba 3 (and PBRT) distribute them in `data/ior`.

Sources. The measurements come from the Luxpop database (www.luxpop.com) and are based on data by Palik ("Handbook of
Optical Constants of Solids", Academic Press) and on atomic scattering factors measured by the Center for X-Ray Optics
(CXRO, Berkeley) and the Lawrence Livermore National Laboratory; Mitsuba's documentation says the same of its table.
The color matching functions are the CIE 1931 2° observer (CIE 018:2019), in `cie_1931_d65_5nm.csv`.

Quadrature. 1000 equidistant wavelengths from 360 to 830 nm, linear interpolation, equal-energy weight: the rule of
Mitsuba's RGB variants, so that one material name means one set of numbers in both renderers.
"""

import csv
import sys
from collections.abc import Iterator
from pathlib import Path

HERE = Path(__file__).parent
STEPS, FIRST, LAST = 1000, 360.0, 830.0
# Integral of the CIE y curve over 360-830 nm: a flat spectrum of 1 has luminance 1.
Y_INTEGRAL = 106.7502593994140625
XYZ_TO_SRGB = (
    (3.240479, -1.537150, -0.498535),
    (-0.969256, 1.875991, 0.041556),
    (0.055648, -0.204043, 1.057311),
)


def interpolate(xs: list[float], ys: list[float], x: float) -> float:
    """Linear interpolation; zero outside of the data."""
    if x < xs[0] or x > xs[-1]:
        return 0.0
    hi = next((i for i in range(1, len(xs)) if xs[i] >= x), len(xs) - 1)
    t = (x - xs[hi - 1]) / (xs[hi] - xs[hi - 1])
    return ys[hi - 1] * (1.0 - t) + ys[hi] * t


def read_spd(path: Path) -> tuple[list[float], list[float]]:
    """Wavelengths and values of an .spd file."""
    lines = (line.split("#")[0].split() for line in path.read_text(encoding="latin-1").splitlines())
    pairs = [(float(line[0]), float(line[1])) for line in lines if line]
    return [w for w, _ in pairs], [v for _, v in pairs]


def weights() -> Iterator[tuple[float, list[float]]]:
    """Wavelengths of the quadrature and the XYZ weight of each."""
    with (HERE / "cie_1931_d65_5nm.csv").open(encoding="utf-8") as file:
        rows = [[float(x) for x in row] for row in csv.reader(line for line in file if line[0].isdigit())]
    nodes = [row[0] for row in rows]
    for i in range(STEPS):
        x = FIRST + i / (STEPS - 1) * (LAST - FIRST)
        scale = (LAST - FIRST) / STEPS / Y_INTEGRAL
        yield x, [interpolate(nodes, [row[c] for row in rows], x) * scale for c in (1, 2, 3)]


def to_srgb(spd: tuple[list[float], list[float]], quadrature: list[tuple[float, list[float]]]) -> list[float]:
    """Linear sRGB of a spectrum under equal energy; negative components (out of gamut) become zero."""
    xyz = [0.0, 0.0, 0.0]
    for x, weight in quadrature:
        value = interpolate(*spd, x)
        xyz = [total + w * value for total, w in zip(xyz, weight, strict=True)]
    return [max(0.0, sum(m * c for m, c in zip(row, xyz, strict=True))) for row in XYZ_TO_SRGB]


def main(folder: Path) -> None:
    """Write the table from the spectra in a folder."""
    quadrature = list(weights())
    with (HERE / "conductors.csv").open("w", encoding="utf-8") as out:
        out.write("# Written by make_conductors.py, which names the sources. Complex index eta + i k in linear sRGB.\n")
        out.write("# name,eta r,eta g,eta b,k r,k g,k b\n")
        for eta in sorted(folder.glob("*.eta.spd"), key=lambda path: path.name.lower()):
            name = eta.name.removesuffix(".eta.spd")
            values = to_srgb(read_spd(eta), quadrature) + to_srgb(read_spd(folder / f"{name}.k.spd"), quadrature)
            out.write(",".join([name] + [f"{value:.6g}" for value in values]) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
