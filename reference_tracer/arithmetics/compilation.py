"""Kernels in machine code: the instantiated source as a program for the compiler (reference_tracer/compiler)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.types import Array, Float, Integer, Tuple
from raytruth.reference_tracer.source.scene_data import SceneData
from raytruth.scenes.scene import LARGEST_DEPTH

if TYPE_CHECKING:
    from collections.abc import Mapping

    from raytruth.reference_tracer.compiler.types import Type

# Tracing takes one ray from the stack and puts at most three there, each one level deeper: a mirror's and two of a
# dielectric. So the stack grows by two a level at most, from the one camera ray on.
STACK_CAPACITY = 2 * LARGEST_DEPTH + 1


def kernel_program(source: str, numbers: Mapping[str, float], number_type: type[np.float32 | np.float64]) -> Program:
    """The source of a kernel in a number type of NumPy's; `numbers` are its literals and constants by name."""
    number, integer = Float(np.dtype(number_type).itemsize * 8), Integer()
    scene = Tuple((Array(number), Array(integer)), SceneData._fields, SceneData.__name__)
    names: dict[str, Any] = {
        **{name: getattr(math, name) for name in ("exp", "floor", "sqrt", "tan")},
        **{name: number_type(value) for name, value in (*numbers.items(), ("inf", math.inf), ("pi", math.pi))},
        "float": number_type,
    }
    entry_points: dict[str, tuple[Type, ...]] = {
        "render_rows": (scene, integer, integer, integer, Array(number, 3)),
        "first_hit_rows": (scene, integer, integer, Array(number, 2), Array(integer, 2)),
    }
    return Program(source, f"<kernel in {np.dtype(number_type).name}>", names, entry_points, {}, STACK_CAPACITY)
