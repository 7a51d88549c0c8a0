"""Kernels in machine code: the instantiated source as a program for the compiler (reference_tracer/compiler)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.questions import marks_taken
from raytruth.reference_tracer.compiler.types import Array, Integer, Tuple, type_of
from raytruth.reference_tracer.source.scene_data import SceneData
from raytruth.scenes.scene import LARGEST_DEPTH

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.reference_tracer.compiler.types import Type

# Tracing takes one ray from the stack and puts at most three there, each one level deeper: a mirror's and two of a
# dielectric. So the stack grows by two a level at most, from the one camera ray on.
STACK_CAPACITY = 2 * LARGEST_DEPTH + 1
INTEGER = Integer()


class CompiledArithmetic(Protocol):
    """What is compiled of an arithmetic (arithmetic.py)."""

    @property
    def name(self) -> str:
        """What it is called in messages."""

    @property
    def number(self) -> Callable[[float], Any]:
        """Makes a number of a float."""

    @property
    def functions(self) -> Mapping[str, Any]:
        """What the source takes from `math` or defines itself, by name."""

    @property
    def operations(self) -> Mapping[str, Callable[..., Any]]:
        """What operators do."""


def kernel_program(
    source: str,
    numbers: Mapping[str, float],
    arithmetic: CompiledArithmetic,
    entry_points: Mapping[str, tuple[Type, ...]],
) -> Program:
    """The source of a kernel in a number type; `numbers` are its literals and constants by name."""
    names: dict[str, Any] = {name: arithmetic.number(value) for name, value in numbers.items()}
    names |= {"float": arithmetic.number, "marks_taken": marks_taken, **arithmetic.functions}
    file = f"<kernel in {arithmetic.name}>"
    return Program(source, file, names, entry_points, arithmetic.operations, STACK_CAPACITY)


def image_entry_points(arithmetic: CompiledArithmetic) -> dict[str, tuple[Type, ...]]:
    """What Python calls of a kernel that makes images, with the types of the arguments."""
    number, scene = number_type(arithmetic), scene_type(arithmetic)
    return {
        "render_rows": (scene, INTEGER, INTEGER, INTEGER, Array(number, 3)),
        "first_hit_rows": (scene, INTEGER, INTEGER, Array(number, 2), Array(INTEGER, 2)),
    }


def scene_type(arithmetic: CompiledArithmetic) -> Tuple:
    """The type of SceneData."""
    return Tuple((Array(number_type(arithmetic)), Array(INTEGER)), SceneData._fields, SceneData.__name__)


def number_type(arithmetic: CompiledArithmetic) -> Type:
    """The type of a number of this arithmetic."""
    found = type_of(arithmetic.number(0.0))
    assert found is not None, f"{arithmetic.name} has no numbers that the compiler knows"
    return found
