"""What a failing property prints: its numbers in hexadecimal, which lose nothing, and the command that repeats it."""

from __future__ import annotations

import os
from typing import Any

from hypothesis import note


def in_hex(value: Any) -> str:
    """Floats as `float.hex` writes them, within tuples too; everything else as `repr` does."""
    if isinstance(value, float):
        # Not float.fromhex('…') around each number: a ray would no longer fit on a line.
        return value.hex()
    if isinstance(value, tuple | list):
        return "(" + ", ".join(map(in_hex, value)) + ")"
    return repr(value)


def repeating_command() -> str:
    """The command that runs the test that is running, with the examples of this run."""
    test = os.environ["PYTEST_CURRENT_TEST"].rsplit(" ", 1)[0]
    return f"python -m pytest '{test}'"


def note_case(**values: Any) -> None:
    """Let hypothesis print these values, one a line, and the command, if the test fails."""
    lines = [f"{name} = {in_hex(value)}" for name, value in values.items()]
    note("\n".join([*lines, f"repeat: {repeating_command()}"]))
