"""The types of the tracer's source.

The source is written over scalars and vectors of scalars. `float` stands here for whatever number type the source is
instantiated with (reference_tracer/arithmetics/arithmetic.py): a Python float, a compiled float64 or float32, a ball.
"""

from __future__ import annotations

from typing import Any, TypeAlias

Scalar: TypeAlias = float
Vector: TypeAlias = tuple[float, float, float]
"""A point, a direction, or a colour in linear RGB."""

Table: TypeAlias = Any
"""Numbers of the scene in an array of shape (n, 3) or (n,): float64, float32, or objects for balls."""
