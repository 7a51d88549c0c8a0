"""What an answer holds, as JSON too: names and shapes of its values."""

from __future__ import annotations

from pydantic import Field

from raytruth.comparisons.records.results import Record


class CertifiedNumber(Record):
    """The exact number lies between middle - radius and middle + radius; both in decimal and as C's %a writes them."""

    middle: float
    radius: float
    middle_hex: str
    radius_hex: str


class NumberRange(Record):
    """A number of a program lies between low and high, ends included."""

    low: float
    high: float
    low_hex: str
    high_hex: str


Value = bool | CertifiedNumber | tuple[CertifiedNumber, ...]
Outcome = dict[str, bool | NumberRange | tuple[NumberRange | None, ...] | None]
"""One way that a program may answer; None for a number of which nothing can be said."""


class OracleAnswer(Record):
    """What is true, and what a program may give that computes in float32 or float64."""

    ask: str
    id: str | int | None = None
    truth: dict[str, Value] | None = Field(description="By name; none where a tie leaves it open.")
    undecided: str = Field("", description="Why there is no truth, else empty.")
    float32: tuple[Outcome, ...] | None = Field(
        description="Each way that rounding leaves open: a program is right that gives all values of one of them. "
        "None where they are too many."
    )
    float64: tuple[Outcome, ...] | None = Field(description="The same for a program that computes in float64.")
