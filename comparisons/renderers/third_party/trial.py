"""Loads one adapter and looks at it, in a process of its own: whatever it does, it does it to this process.

Arguments: what the entry point names, as in `package.module:function`. What is wrong is the last line that it prints.
"""

from __future__ import annotations

import sys
from importlib.metadata import EntryPoint

from raytruth.comparisons.renderers.third_party.entry_points import GROUP
from raytruth.comparisons.renderers.third_party.requirements import what_is_wrong


def main(value: str) -> None:
    """Try it; the exit status is 1 if anything is wrong with it."""
    # In one line, since nobody looks for the cause in a traceback that begins here.
    sys.excepthook = lambda kind, error, _: print(f"{kind.__name__}: {error}", file=sys.stderr)
    problem = what_is_wrong(EntryPoint("trial", value, GROUP).load()())
    if problem is not None:
        sys.exit(problem)


if __name__ == "__main__":
    main(*sys.argv[1:])
