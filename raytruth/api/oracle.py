"""Proven answers to single steps of a ray tracer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.oracle.lines import answered

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.comparisons.oracle.answer import OracleAnswer


def oracle(question: Mapping[str, object]) -> OracleAnswer:
    """What is true of one step of a ray tracer, and all that float32 and float64 may give instead.

    The question has the keys that a line of `raytruth oracle` has (docs/oracle.md). Raises QuestionError with one
    sentence for each mistake.
    """
    return answered(dict(question))
