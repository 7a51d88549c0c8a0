"""One text run in two ways: by Python, and as machine code."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from raytruth.reference_tracer.compiler.compilation import Program
from raytruth.reference_tracer.compiler.types import Array, Float, Integer

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from raytruth.reference_tracer.compiler.types import Type

NUMBER, INTEGER = Float(64), Integer()
NUMBERS, INTEGERS = Array(NUMBER), Array(INTEGER)
MATH: dict[str, Any] = {name: getattr(math, name) for name in ("sqrt", "floor", "exp", "tan", "inf")}
FILE = "text of a test"


def program(
    text: str,
    *kinds: Type,
    names: Mapping[str, Any] = MATH,
    operations: Mapping[str, Callable[..., Any]] | None = None,
    capacity: int = 8,
) -> Program:
    """A program whose one entry point is `run`."""
    return Program(text, FILE, names, {"run": kinds}, operations or {}, capacity)


def compiled(text: str, *kinds: Type, names: Mapping[str, Any] = MATH, **more: Any) -> Callable[..., None]:
    """The function `run` of the text, as machine code."""
    return program(text, *kinds, names=names, **more).compiled()["run"]


def interpreted(text: str, names: Mapping[str, Any] = MATH) -> Callable[..., None]:
    """The function `run` of the text, as Python runs it."""
    namespace = dict(names)
    exec(text, namespace)
    run: Callable[..., None] = namespace["run"]
    return run
