from __future__ import annotations

import base64
import json
import re
import shlex
import zlib
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

import numpy as np
import pytest

from raytruth.comparisons.records.image_files import read_image, write_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.comparisons.records.results import Cell
from raytruth.reports.loading import ReportError
from raytruth.reports.pixel_scripts import PixelView, write_pixel_script
from tests.reports.sample_results import AMBIGUOUS_PIXEL, FAILING_PIXEL, HOSTILE, SIDE, sample_document

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("REP-3")

FAILING = 3
"""The place of the failing cell in the sample."""
STOCHASTIC = 2
KINDS = {"value": "<f4", "truth": "<f4", "distance": "<f4", "low": "<f4", "high": "<f4"}


def sample_cell(directory: Path, place: int = FAILING, **changes: Any) -> Cell:
    return Cell.model_validate({**sample_document(directory)["cells"][place], **changes})


def written(directory: Path, cell: Cell) -> tuple[PixelView, dict[str, Any]]:
    assert cell.images is not None
    view = write_pixel_script(directory, cell, cell.images, "cell/of/a/test", directory / "pixels")
    text = (directory / unquote(view.address)).read_text(encoding="ascii")
    call = re.fullmatch(r'raytruthPixels\("cell/of/a/test", (\{.*\})\);\n', text)
    assert call is not None
    return view, json.loads(call[1])


def array(data: dict[str, Any], name: str, *shape: int) -> NDArray[Any]:
    numbers = np.frombuffer(zlib.decompress(base64.b64decode(data[name])), KINDS.get(name, "u1"))
    return numbers.reshape(shape)


def test_the_script_holds_every_number_of_the_cells_images(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path)
    assert cell.images is not None
    _, data = written(tmp_path, cell)
    assert (data["width"], data["height"]) == (SIDE, SIDE)
    for name, path in {
        "value": cell.images.render,
        "truth": cell.images.truth,
        "distance": cell.images.tolerances,
    }.items():
        np.testing.assert_array_equal(array(data, name, SIDE, SIDE, 3), read_image(tmp_path / path), err_msg=name)
    evidence = read_pixel_evidence(tmp_path / cell.images.feasible)
    outcomes = array(data, "outcomes", SIDE, SIDE).astype(int)
    np.testing.assert_array_equal(array(data, "nearest", SIDE, SIDE), evidence.nearest)
    np.testing.assert_array_equal(array(data, "merged", SIDE, SIDE), evidence.merged)
    low, high = array(data, "low", -1, 3), array(data, "high", -1, 3)
    assert len(low) == len(high) == outcomes.sum()
    first = np.concatenate([[0], np.cumsum(outcomes.ravel())[:-1]]).reshape(SIDE, SIDE)
    for x, y in (AMBIGUOUS_PIXEL, FAILING_PIXEL, (0, 0), (SIDE - 1, SIDE - 1)):
        boxes = slice(first[y, x], first[y, x] + outcomes[y, x])
        np.testing.assert_array_equal(low[boxes], evidence.low[y, x, : outcomes[y, x]])
        np.testing.assert_array_equal(high[boxes], evidence.high[y, x, : outcomes[y, x]])
    counts = [int(outcomes[y, x]) for x, y in (AMBIGUOUS_PIXEL, FAILING_PIXEL, (0, 0))]
    assert counts == [3, 1, 0]


def test_the_page_is_told_the_worst_pixel_and_the_command(tmp_path: Path) -> None:
    view, _ = written(tmp_path, sample_cell(tmp_path))
    assert (view.x, view.y) == FAILING_PIXEL
    assert view.explain == "raytruth explain lambert-sphere --pixel "
    assert not view.is_mean
    assert written(tmp_path, sample_cell(tmp_path, STOCHASTIC))[0].is_mean


@pytest.mark.parametrize("source", ["scenes/mine.json", "it's; rm -rf $HOME.json", HOSTILE])
def test_the_command_names_the_scene_as_the_run_did(source: str, tmp_path: Path) -> None:
    view, _ = written(tmp_path, sample_cell(tmp_path, source=source))
    assert shlex.split(view.explain + "3,4") == ["raytruth", "explain", source, "--pixel", "3,4"]


@pytest.mark.parametrize("name", ["..", ".", "../../outside", "/etc/outside", "a+b", "ü <b>%20", "a\\b"])
def test_whatever_the_names_are_the_script_lies_in_the_folder(name: str, tmp_path: Path) -> None:
    cell = sample_cell(tmp_path).model_copy(update={"scene": name, "renderer": name, "integrator": name})
    before = {path for path in tmp_path.rglob("*") if path.is_file()}
    view, _ = written(tmp_path, cell)
    new = {path for path in tmp_path.rglob("*") if path.is_file()} - before
    assert [path.parent for path in new] == [tmp_path / "pixels"]
    assert re.fullmatch(r"pixels/[\w.%~+-]+\.js", view.address)


def test_different_cells_have_different_scripts(tmp_path: Path) -> None:
    names = [("a", "b", "c+d"), ("a", "b+c", "d"), ("a+b", "c", "d"), ("a%2Bb", "c", "d")]
    cell = sample_cell(tmp_path)
    addresses = {
        written(tmp_path, cell.model_copy(update=dict(zip(("scene", "renderer", "integrator"), name, strict=True))))[0]
        for name in names
    }
    assert len({view.address for view in addresses}) == len(names)


def test_images_of_different_sizes_get_one_sentence(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path)
    assert cell.images is not None
    write_image(tmp_path / cell.images.render, np.zeros((SIDE - 1, SIDE, 3), dtype=np.float32))
    with pytest.raises(ReportError, match="differ in size"):
        written(tmp_path, cell)


@pytest.mark.parametrize("image", ["render", "truth", "tolerances", "feasible"])
def test_a_missing_image_gets_one_sentence(image: str, tmp_path: Path) -> None:
    cell = sample_cell(tmp_path)
    (tmp_path / getattr(cell.images, image)).unlink()
    with pytest.raises(ReportError, match=rf"{image}\.exr is missing"):
        written(tmp_path, cell)


def test_a_name_that_is_too_long_for_a_file_gets_one_sentence(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path).model_copy(update={"scene": "s" * 300})
    with pytest.raises(ReportError, match="cannot be written"):
        written(tmp_path, cell)
