from __future__ import annotations

import base64
import json
import re
import shlex
import zlib
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.records.image_files import read_image, write_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.comparisons.records.results import Cell
from raytruth.reports.cell_arrays import cell_arrays, viewer_data
from raytruth.reports.cell_images import CellImages
from raytruth.reports.loading import ReportError
from raytruth.reports.parts import Parts
from tests.reports.sample_results import AMBIGUOUS_PIXEL, FAILING_PIXEL, HOSTILE, SIDE, sample_document

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

pytestmark = pytest.mark.clause("REP-3")

FAILING = 3
"""The place of the failing cell in the sample."""
STOCHASTIC = 2


def sample_cell(directory: Path, place: int = FAILING, **changes: Any) -> Cell:
    return Cell.model_validate({**sample_document(directory)["cells"][place], **changes})


def images_of(directory: Path, cell: Cell) -> CellImages:
    assert cell.images is not None
    return CellImages(directory, cell.images, "a test")


def written(directory: Path, cell: Cell) -> dict[str, dict[str, NDArray[Any]]]:
    """The arrays as the page unpacks them."""
    names = cell_arrays(images_of(directory, cell), Parts(directory / "report"))
    return {name: unpacked(directory / "report" / path, path) for name, path in names.items()}


def unpacked(path: Path, name: str) -> dict[str, NDArray[Any]]:
    call = re.fullmatch(rf'raytruthArrays\("{re.escape(name)}", (\{{.*\}})\);\n', path.read_text(encoding="ascii"))
    assert call is not None
    return {key: array(packed) for key, packed in json.loads(call[1]).items()}


def array(packed: dict[str, Any]) -> NDArray[Any]:
    kind = np.dtype(packed["kind"])
    planes = np.frombuffer(zlib.decompress(base64.b64decode(packed["bytes"])), np.uint8).reshape(kind.itemsize, -1)
    return np.frombuffer(planes.T.tobytes(), kind).reshape(packed["shape"])


def test_the_scripts_hold_every_number_of_the_cells_images(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path)
    assert cell.images is not None
    arrays = written(tmp_path, cell)
    judgement = arrays["judgement"]
    for found, path in [
        (arrays["render"]["value"], cell.images.render),
        (arrays["truth"]["value"], cell.images.truth),
        (judgement["distance"], cell.images.tolerances),
    ]:
        np.testing.assert_array_equal(found, read_image(tmp_path / path), err_msg=path)
    evidence = read_pixel_evidence(tmp_path / cell.images.feasible)
    outcomes = judgement["outcomes"].astype(int)
    np.testing.assert_array_equal(judgement["nearest"], evidence.nearest)
    np.testing.assert_array_equal(judgement["merged"], evidence.merged)
    np.testing.assert_array_equal(judgement["declared"], evidence.declared)
    assert len(judgement["low"]) == len(judgement["high"]) == outcomes.sum()
    first = np.concatenate([[0], np.cumsum(outcomes.ravel())[:-1]]).reshape(SIDE, SIDE)
    for x, y in (AMBIGUOUS_PIXEL, FAILING_PIXEL, (0, 0), (SIDE - 1, SIDE - 1)):
        boxes = slice(first[y, x], first[y, x] + outcomes[y, x])
        np.testing.assert_array_equal(judgement["low"][boxes], evidence.low[y, x, : outcomes[y, x]])
        np.testing.assert_array_equal(judgement["high"][boxes], evidence.high[y, x, : outcomes[y, x]])
    assert [int(outcomes[y, x]) for x, y in (AMBIGUOUS_PIXEL, FAILING_PIXEL, (0, 0))] == [3, 1, 0]


def test_the_variance_of_a_noisy_image_comes_with_it(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path, STOCHASTIC)
    assert cell.images is not None
    assert cell.images.variance is not None
    np.testing.assert_array_equal(
        written(tmp_path, cell)["variance"]["value"], read_image(tmp_path / cell.images.variance)
    )


def test_the_page_is_told_the_worst_pixel_and_the_command(tmp_path: Path) -> None:
    cell, mean = sample_cell(tmp_path), sample_cell(tmp_path, STOCHASTIC)
    told = viewer_data(cell, images_of(tmp_path, cell), {})
    assert tuple(told["worst"]) == FAILING_PIXEL
    assert (told["width"], told["height"]) == (SIDE, SIDE)
    assert told["explain"] == "raytruth explain lambert-sphere --pixel "
    assert not told["isMean"]
    assert viewer_data(mean, images_of(tmp_path, mean), {})["isMean"]


@pytest.mark.parametrize("source", ["scenes/mine.json", "it's; rm -rf $HOME.json", HOSTILE])
def test_the_command_names_the_scene_as_the_run_did(source: str, tmp_path: Path) -> None:
    cell = sample_cell(tmp_path, source=source)
    explain = viewer_data(cell, images_of(tmp_path, cell), {})["explain"]
    assert shlex.split(explain + "3,4") == ["raytruth", "explain", source, "--pixel", "3,4"]


def test_images_of_different_sizes_get_one_sentence(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path)
    assert cell.images is not None
    write_image(tmp_path / cell.images.tolerances, np.zeros((SIDE - 1, SIDE, 3), dtype=np.float32))
    with pytest.raises(ReportError, match="differ in size"):
        written(tmp_path, cell)


@pytest.mark.parametrize("image", ["render", "truth", "tolerances", "feasible"])
def test_a_missing_image_gets_one_sentence(image: str, tmp_path: Path) -> None:
    cell = sample_cell(tmp_path)
    (tmp_path / getattr(cell.images, image)).unlink()
    with pytest.raises(ReportError, match=rf"{image}\.exr is missing"):
        written(tmp_path, cell)


@pytest.mark.clause("REP-2")
def test_control_characters_of_names_are_marks(tmp_path: Path) -> None:
    cell = sample_cell(tmp_path, source="a\u202eb\x1b")
    assert "a\ufffdb\ufffd" in viewer_data(cell, images_of(tmp_path, cell), {})["explain"]
