"""`python -m raytruth`.

Python then looks for modules in the working directory first, where a folder called `scenes` would hide ours. What
raytruth needs is beside its own package or installed.
"""

import sys
from pathlib import Path

if __name__ == "__main__":
    if not sys.flags.safe_path:
        sys.path[0] = str(Path(__file__).resolve().parents[1])
    from raytruth.command_line import main

    sys.exit(main())
