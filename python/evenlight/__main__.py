"""``python -m evenlight`` is ``evenlight``."""

import sys

from evenlight.cli import main

if __name__ == "__main__":
    sys.exit(main())
