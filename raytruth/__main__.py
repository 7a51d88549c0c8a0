"""`python -m raytruth`."""

import sys

if __name__ == "__main__":
    from raytruth.command_line import main

    sys.exit(main())
