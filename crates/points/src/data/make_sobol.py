"""Pack the Joe-Kuo direction numbers that SciPy ships into ``sobol.bin`` and check the result.

Run with a Python that has SciPy: ``python make_sobol.py``. The format is described in README.md.
"""

from pathlib import Path

import numpy as np
import scipy.stats

RECORD = 24  # bytes per dimension
BITS = 160  # of a record that hold the initial numbers


def pack(polynomial: int, initial: list[int]) -> bytes:
    """One record: the odd m_i < 2^i without their last bit, i - 1 bits each, then the polynomial."""
    degree = polynomial.bit_length() - 1
    packed, position = 0, 0
    for i in range(1, degree + 1):
        m = initial[i - 1]
        assert m % 2 == 1 and m < 2**i, (polynomial, i, m)
        packed |= (m >> 1) << position
        position += i - 1
    assert position <= BITS
    return (packed | polynomial << BITS).to_bytes(RECORD, "little")


def unpack(record: bytes) -> tuple[int, list[int]]:
    """Undo ``pack``."""
    whole = int.from_bytes(record, "little")
    polynomial, packed, initial = whole >> BITS, whole & ((1 << BITS) - 1), []
    for i in range(1, polynomial.bit_length()):
        initial.append((packed & ((1 << (i - 1)) - 1)) << 1 | 1)
        packed >>= i - 1
    return polynomial, initial


def main() -> None:
    """Write ``sobol.bin`` beside this file."""
    source = Path(scipy.stats.__file__).parent / "_sobol_direction_numbers.npz"
    with np.load(source) as arrays:
        polynomials, initial = arrays["poly"].tolist(), arrays["vinit"].tolist()
    records = [pack(p, m) for p, m in zip(polynomials, initial, strict=True)]
    for record, p, m in zip(records, polynomials, initial, strict=True):
        degree = p.bit_length() - 1
        assert unpack(record) == (p, m[:degree])
    target = Path(__file__).with_name("sobol.bin")
    target.write_bytes(b"".join(records))
    print(f"{target.name}: {len(records)} dimensions, {target.stat().st_size} bytes")


if __name__ == "__main__":
    main()
