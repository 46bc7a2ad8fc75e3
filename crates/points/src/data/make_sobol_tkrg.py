"""Pack the direction numbers tkrg-a-ap5 of the package tklds into ``sobol_tkrg.bin`` and check the result.

``python make_sobol_tkrg.py [FILE]``: the file is ``tklds/direction_numbers/tkrgsobol_a_ap5_50000`` of the wheel
tklds 0.2.0 (``pip download --no-deps tklds==0.2.0`` gets it); without one, that of an installed tklds. The format is
described in README.md.
"""

import hashlib
import importlib.util
import sys
from pathlib import Path

DIGEST = "ed0ea890a6e155151d19d122b715e6ce34f0d75a65d88cfb3bc677241833a5d4"


def read(source: Path) -> list[tuple[int, list[int]]]:
    """Polynomial and initial numbers of each dimension from the second on."""
    assert hashlib.sha256(source.read_bytes()).hexdigest() == DIGEST, f"{source} is another file"
    lines = [[int(field) for field in line.split()] for line in source.read_text().splitlines()[1:]]
    return [(1 << degree | inner << 1 | 1, initial) for _, degree, inner, *initial in lines]


def pack(previous: int, polynomial: int, initial: list[int]) -> bytes:
    """One record: half of what the polynomial is larger by, then the odd m_i < 2^i without their last bit."""
    packed, position = 0, 0
    for i, m in enumerate(initial):
        assert m % 2 == 1 and m < 2 << i, (polynomial, i, m)
        packed |= (m >> 1) << position
        position += i
    return bytes([(polynomial - previous) // 2]) + packed.to_bytes((position + 7) // 8, "little")


def unpack(records: bytes) -> list[tuple[int, list[int]]]:
    """Undo ``pack``."""
    dimensions, polynomial, at = [], 1, 0
    while at < len(records):
        polynomial += 2 * records[at]
        degree = polynomial.bit_length() - 1
        end = at + 1 + (degree * (degree - 1) // 2 + 7) // 8
        packed, initial = int.from_bytes(records[at + 1 : end], "little"), []
        for i in range(degree):
            initial.append((packed & ((1 << i) - 1)) << 1 | 1)
            packed >>= i
        dimensions.append((polynomial, initial))
        at = end
    return dimensions


def main() -> None:
    """Write ``sobol_tkrg.bin`` beside this file."""
    if len(sys.argv) > 1:
        source = Path(sys.argv[1])
    else:
        package = importlib.util.find_spec("tklds")
        assert package and package.submodule_search_locations, "tklds is not installed: name the file"
        source = Path(package.submodule_search_locations[0], "direction_numbers", "tkrgsobol_a_ap5_50000")
    dimensions = read(source)
    before = [1, *(polynomial for polynomial, _ in dimensions)]
    records = b"".join(pack(previous, *dimension) for previous, dimension in zip(before, dimensions, strict=False))
    assert unpack(records) == dimensions
    target = Path(__file__).with_name("sobol_tkrg.bin")
    target.write_bytes(records)
    print(f"{target.name}: {1 + len(dimensions)} dimensions, {len(records)} bytes")


if __name__ == "__main__":
    main()
