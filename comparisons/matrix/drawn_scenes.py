"""Scenes drawn over all that the scene format can say, as scene files that a run judges like any others."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

from raytruth.scenes.exporters.json_scene import export_json
from raytruth.scenes.families.language import language, rows

if TYPE_CHECKING:
    from pathlib import Path

DRAWN_FOLDER = "drawn-scenes"


def write_drawn_scenes(directory: Path, count: int, seed: int) -> tuple[str, ...]:
    """So many scenes of the family `language`, as files below the directory; returns their paths.

    Each has another row of the family as long as there are any, in an order that the seed draws; the same count and
    seed give the same scenes.
    """
    order = list(range(len(rows())))
    Random(seed).shuffle(order)
    folder = directory / DRAWN_FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for number in range(count):
        row, of_row = order[number % len(order)], seed + number // len(order)
        scene = language(float(row), of_row).model_copy(update={"name": f"row-{row}-seed-{of_row}"})
        paths.append(str(export_json(scene, folder)))
    return tuple(paths)
