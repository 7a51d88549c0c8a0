"""Rows of enclosed pixels: what a compiled kernel of balls is asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.reference_tracer.compiler.questions import marks_taken
from raytruth.reference_tracer.source.pixel_rows import radiance_at
from raytruth.reference_tracer.source.scene_data import CAMERA_SIZE, integer_of

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.camera import Frame
    from raytruth.reference_tracer.source.numbers import Table
    from raytruth.reference_tracer.source.scene_data import SceneData


def enclosed_rows(scene: SceneData, frame: Frame, first: int, end: int, colors: Table, marks: Table) -> None:
    """Colours and marks of the rows `first` to `end` - 1, in arrays that begin with row `first`.

    A pixel that is marked has had an undecided comparison, and its colour says nothing.
    """
    for row in range(first, end):
        for column in range(integer_of(scene, CAMERA_SIZE, 0)):
            color = radiance_at(scene, frame, float(column) + 0.5, float(row) + 0.5)
            for channel in range(3):
                colors[row - first, column, channel] = color[channel]
            marks[row - first, column] = marks_taken()
