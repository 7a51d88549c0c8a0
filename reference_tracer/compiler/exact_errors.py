"""What rounding a product loses, exactly: one instruction where the processor has it, else a row of operations."""

from __future__ import annotations

from typing import NamedTuple

# Veltkamp's constant: 27 of 53 bits go to the upper part (Dekker 1971).
SPLITTER = 2.0**27 + 1.0


class Halves(NamedTuple):
    """Two floats whose sum is a third one."""

    high: float
    low: float


def product_error(a: float, b: float) -> float:
    """a·b minus the rounded product, exactly, if nothing overflows and its last bit is a float (Dekker 1971).

    Compiled code computes it as the processor's fused a·b + c, which rounds once, where there is one.
    """
    product = a * b
    first, second = halves(a), halves(b)
    rest = ((first.high * second.high - product) + first.high * second.low) + first.low * second.high
    return rest + first.low * second.low


def halves(a: float) -> Halves:
    """Two floats of 26 bits at most, with signs, whose sum is a: their products are exact (Veltkamp; Dekker 1971)."""
    scaled = SPLITTER * a
    high = scaled - (scaled - a)
    return Halves(high, a - high)
