"""Pack Pirsic's Niederreiter-Xing matrices, which SSJ ships, into ``niederreiter_xing.bin`` and check the result.

``python make_niederreiter_xing.py`` downloads SSJ from Maven Central; a path to ``ssj-3.3.1.jar`` as argument spares
the download. The format is described in README.md. Needs Python alone. That the matrices are what they should be is a
test of the crate: their quality parameters are the genera of Niederreiter and Xing.
"""

import hashlib
import io
import struct
import sys
import urllib.request
import zipfile
from pathlib import Path

URL = "https://repo1.maven.org/maven2/ca/umontreal/iro/simul/ssj/3.3.1/ssj-3.3.1.jar"
MEMBER = "umontreal/ssj/hups/dataSer/Nieder/NiedXingSequenceBase2Trans.ser"
SHA256 = "189550308fb310ed24f772ce3cb2cc1e46b843100473deb46616c800b39428be"  # of the member

HEADER = 27  # bytes of Java's serialization before the numbers: an int[]
COLUMNS = 30  # of a matrix; its digits as well
FIRST, LAST = 4, 32  # dimensions


def main() -> None:
    """Write ``niederreiter_xing.bin`` beside this file."""
    jar = Path(sys.argv[1]).read_bytes() if len(sys.argv) > 1 else urllib.request.urlopen(URL).read()
    with zipfile.ZipFile(io.BytesIO(jar)) as archive:
        serialized = archive.read(MEMBER)
    assert hashlib.sha256(serialized).hexdigest() == SHA256
    (count,) = struct.unpack(">i", serialized[HEADER - 4 : HEADER])
    numbers = struct.unpack(f">{count}i", serialized[HEADER:])
    assert count == COLUMNS * sum(range(FIRST, LAST + 1))
    assert all(0 <= number < 1 << COLUMNS for number in numbers)
    packed = struct.pack(f"<{count}I", *numbers)
    target = Path(__file__).with_name("niederreiter_xing.bin")
    target.write_bytes(packed)
    assert struct.unpack(f"<{count}I", target.read_bytes()) == numbers
    print(f"{target.name}: {FIRST} to {LAST} dimensions, {len(packed)} bytes")


if __name__ == "__main__":
    main()
