from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.results import Cell, Results
from raytruth.reports.causes import grouped, kind_of_trouble
from raytruth.reports.cell_images import CellImages
from tests.reports.sample_results import SIDE, sample_document, sphere_image

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("REP-12")

FAILING = 3


def kind(directory: Path, factors: NDArray[np.float32]) -> str:
    """Of a cell whose render is the truth times a factor a pixel; where that is not 1 it fails."""
    cell = Cell.model_validate(sample_document(directory)["cells"][FAILING])
    assert cell.images is not None
    images = CellImages(directory, cell.images, "")
    distances = np.where(factors == 1, 0.5, 7)[..., None].repeat(3, axis=-1).astype(np.float32)
    write_image(directory / cell.images.render, sphere_image() * factors[..., None])
    write_image(directory / cell.images.tolerances, distances)
    return kind_of_trouble(cell, images)


def factors(**places: float) -> NDArray[np.float32]:
    """1 but for the pixels at `x_y`."""
    image = np.ones((SIDE, SIDE), dtype=np.float32)
    for place, factor in places.items():
        x, y = map(int, place[1:].split("_"))
        image[y, x] = factor
    return image


@pytest.mark.parametrize(
    ("image", "expected"),
    [
        (np.full((SIDE, SIDE), 0.5, dtype=np.float32), "Every pixel, too dark"),
        (factors(p5_5=2, p9_9=3), "Single pixels, too bright"),
        (factors(p5_5=2, p6_6=2), "One region of pixels, too bright"),
        (factors(p5_5=2, p6_6=2, p20_20=0.5), "Several regions of pixels, brighter here and darker there"),
        (factors(p5_5=np.nan), "Single pixels, not a finite number"),
        (factors(), "No colour is wrong: the mean or the first hits are"),
    ],
)
def test_the_kind_tells_where_and_how_a_cell_differs(image: NDArray[np.float32], expected: str, tmp_path: Path) -> None:
    assert kind(tmp_path, image) == expected


def results(cells: list[dict[str, Any]], features: dict[str, list[str]]) -> Results:
    scene = {"purpose": "", "convention": "", "width": 1, "height": 1, "light_paths": ""}
    return Results.model_validate(
        {
            "raytruth_version": "",
            "created": "",
            "command": "",
            "machine": {},
            "scenes": [{"name": name, "features": listed, **scene} for name, listed in features.items()],
            "renderers": [],
            "cells": [{"renderer": "r", "integrator": "i", "reason": "", "command": "", **cell} for cell in cells],
        }
    )


def test_groups_are_ordered_by_urgency_and_size_and_name_what_only_they_have() -> None:
    features = {"a": ["sphere", "mirror"], "b": ["sphere", "mirror", "glass"], "c": ["sphere"], "d": [], "e": []}
    cells = [
        {"scene": "a", "verdict": "fail"},
        {"scene": "b", "verdict": "fail"},
        {"scene": "c", "verdict": "pass"},
        {"scene": "d", "verdict": "declared"},
        {"scene": "e", "verdict": "error", "renderer": "never passes"},
    ]
    found = results(cells, features)
    kinds = {cell.folder: {"a": "dark", "b": "dark"}.get(cell.scene, "other") for cell in found.cells}
    groups = grouped(found, kinds)
    assert [(group.outcome, len(group.cells)) for group in groups] == [("fail", 2), ("error", 1), ("declared", 1)]
    assert [group.suspects for group in groups] == [("mirror",), (), ()]


def test_a_reason_is_the_same_kind_whatever_its_numbers_are() -> None:
    cells = [
        Cell(
            scene="s",
            renderer="r",
            integrator="i",
            verdict="error",
            reason=f"it ended; signal {n}, after 0.{n} s",
            command="",
        )  # type: ignore[arg-type] # a string is one of the enumeration
        for n in (6, 11)
    ]
    assert {kind_of_trouble(cell, None) for cell in cells} == {"signal …, after … s"}
