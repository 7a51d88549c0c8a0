"""The proven values of many pixels at once: the tracer compiled for balls of double-double numbers.

It takes a few microseconds a pixel, where Arb's balls take as many hundred. What it leaves undecided, or without a
finite radius, it says; such pixels are Arb's (certification.py).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.compilation import INTEGER, kernel_program, number_type, scene_type
from raytruth.reference_tracer.arithmetics.enclosed_rows import enclosed_rows
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.arithmetics.truth_arithmetic import TRUTH_ARITHMETIC, double_double_of
from raytruth.reference_tracer.compiler.types import Array, Tuple
from raytruth.reference_tracer.tables import build_tables
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from numpy.typing import NDArray

    from raytruth.reference_tracer.arithmetics.arithmetic import Arithmetic
    from raytruth.scenes.scene import Scene

COMPILED_BITS = 106
"""Of a double-double number: twice float64's."""
ENCLOSED_ROWS = enclosed_rows.__name__


@dataclass(frozen=True)
class EnclosedRows:
    """Enclosures of the pixels of some rows, those that are decided; the others' are meaningless."""

    middle: NDArray[np.float64]
    """Shape (rows, width, 3), linear RGB."""
    radius: NDArray[np.float64]
    """Shape (rows, width, 3)."""
    decided: NDArray[np.bool_]
    """Shape (rows, width)."""


class CompiledTruth:
    """A scene's kernel and tables in balls.

    `frame` is what the scene's camera rays share, in Arb's balls: tangents are Arb's.
    """

    def __init__(self, scene: Scene, frame: Any) -> None:
        features = required_features(scene)
        self.width = scene.camera.width
        self.frame = tuple(tuple(map(double_double_of, vector)) for vector in frame)
        self.kernel = enclosing_kernel(TRUTH_ARITHMETIC, features)
        self.data = build_tables(scene, features, TRUTH_ARITHMETIC)

    def rows(self, first: int, end: int) -> EnclosedRows:
        """The pixels of the rows `first` to `end` - 1. Threads may call this side by side."""
        colors = TRUTH_ARITHMETIC.image(end - first, self.width, 3)
        marks = np.zeros((end - first, self.width), dtype=np.int64)
        self.kernel(self.data, self.frame, first, end, colors, marks)
        middle, radius = enclosures(colors)
        finite = np.isfinite(middle) & np.isfinite(radius)
        return EnclosedRows(middle, radius, (marks == 0) & finite.all(axis=2))


def enclosing_kernel(arithmetic: Arithmetic, features: Collection[str]) -> Callable[..., None]:
    """The function `enclosed_rows`, compiled for a scene with these features."""
    behaviour = Behaviour(PLAIN_FORMS, (enclosed_rows,), name="enclosed rows")
    source, literals = kernel_source(features, behaviour, entry_points=(ENCLOSED_ROWS,))
    number = number_type(arithmetic)
    vector = Tuple((number, number, number))
    kinds = (scene_type(arithmetic), Tuple((vector,) * 5), INTEGER, INTEGER, Array(number, 3), Array(INTEGER, 2))
    return kernel_program(source, literals, arithmetic, {ENCLOSED_ROWS: kinds}).compiled()[ENCLOSED_ROWS]


def enclosures(balls: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Middles and radii in float64 of balls of double-double numbers, an array of shape (…, 3): high, low, radius.

    A rounded sum is the float beside the true one at most, unless it is exact, as it is where one of both is 0.
    """
    high, low, radius = np.moveaxis(balls, -1, 0)
    total = np.abs(low) + radius
    is_exact = (low == 0.0) | (radius == 0.0)
    return high, np.where(is_exact, total, np.nextafter(total, math.inf))
