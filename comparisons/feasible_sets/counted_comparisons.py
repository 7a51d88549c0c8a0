"""The comparisons of a compiled kernel, of numbers and of whole numbers, each counted: as balls.py counts Arb's."""

from __future__ import annotations

from typing import Any

from raytruth.reference_tracer.arithmetics.scripted_decisions import count_comparison


def is_less(a: Any, b: Any) -> Any:
    """Whether a < b."""
    count_comparison()
    return a < b


def is_greater(a: Any, b: Any) -> Any:
    """Whether a > b."""
    count_comparison()
    return b < a


def is_less_or_equal(a: Any, b: Any) -> Any:
    """Whether a ≤ b."""
    count_comparison()
    return a <= b


def is_greater_or_equal(a: Any, b: Any) -> Any:
    """Whether a ≥ b."""
    count_comparison()
    return b <= a


def is_equal(a: Any, b: Any) -> Any:
    """Whether a = b."""
    count_comparison()
    return a == b


def is_different(a: Any, b: Any) -> Any:
    """Whether a ≠ b."""
    count_comparison()
    return not a == b  # noqa: SIM201 - of balls only equality is an operation


COMPARISONS = {
    function.__name__: function
    for function in (is_less, is_greater, is_less_or_equal, is_greater_or_equal, is_equal, is_different)
}
"""By the names that kernels have for them (instantiation.py)."""
