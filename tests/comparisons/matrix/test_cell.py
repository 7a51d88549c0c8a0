from __future__ import annotations

import shlex
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.feasible_set import UNUSED
from raytruth.comparisons.matrix.cell import CELL_FILE
from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.pixel_evidence import pixel_evidence, read_pixel_evidence
from raytruth.comparisons.records.renderings import FirstHits, RendererError, Rendering
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.protocol import Integrator
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.comparisons.matrix.small_cells import cell_of, expectation, judged, noisy

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-3", "VER-4", "VER-9", "VER-10", "REN-1")

FOLDER = "cells/small/pretender-whitted"
FIRST_HITS_ONLY = (Integrator("whitted", "E", gives="first hits"),)


def files(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_a_right_image_passes_and_everything_lies_in_the_cells_folder(tmp_path: Path) -> None:
    cell = cell_of(tmp_path)
    assert cell.verdict == Verdict.PASS
    assert (cell.seconds, cell.version, cell.key) == (0.5, "1", "abc")
    assert cell.largest_error is not None
    assert cell.largest_error <= 2.0**-25  # half an ulp of a float32 below 1
    folder = "cells/small/pretender-whitted"
    names = (CELL_FILE, "log.txt", "render.exr", "tolerances.exr", "feasible.exr")
    assert files(tmp_path) == {f"{folder}/{name}" for name in names}
    assert Cell.model_validate_json((tmp_path / folder / CELL_FILE).read_text()) == cell
    assert cell.images is not None
    np.testing.assert_array_equal(read_image(tmp_path / cell.images.render), expectation().truth.astype(np.float32))
    assert read_image(tmp_path / cell.images.tolerances).max() <= 1
    kept = read_pixel_evidence(tmp_path / cell.images.feasible)
    exact = expectation().feasible
    expected = pixel_evidence(
        exact.low, exact.high, np.zeros((4, 6), dtype=np.int64), exact.merged, np.zeros((4, 6), bool)
    )
    np.testing.assert_array_equal(kept.low, expected.low)
    np.testing.assert_array_equal(kept.high, expected.high)
    assert cell.images.truth == "cells/small/truth.exr"
    assert cell.source == "small"
    assert (tmp_path / folder).stat().st_mode & 0o777 == 0o755  # others may read it


def failing(_scene: Scene, folder: Path) -> Rendering:
    (folder / "log.txt").write_text("Illegal instruction\n", encoding="utf-8")
    raise RendererError("it ended with signal 4")


def test_a_renderer_that_fails_gives_an_error_cell_with_its_log(tmp_path: Path) -> None:
    cell = cell_of(tmp_path, failing)
    assert (cell.verdict, cell.reason) == (Verdict.ERROR, "it ended with signal 4")
    assert cell.log == "cells/small/pretender-whitted/log.txt"
    assert (tmp_path / cell.log).read_text() == "Illegal instruction\n"
    assert cell.images is None
    assert files(tmp_path) == {f"cells/small/pretender-whitted/{name}" for name in (CELL_FILE, "log.txt")}


def test_an_error_without_a_log_names_none(tmp_path: Path) -> None:
    def silent(_scene: Scene, _folder: Path) -> Rendering:
        raise RendererError("it did not start")

    assert cell_of(tmp_path, silent).log is None


@pytest.mark.parametrize("shape", [(4, 5, 3), (6, 4, 3), (4, 6), (4, 6, 4)])
def test_an_image_of_another_size_is_an_error(shape: tuple[int, ...], tmp_path: Path) -> None:
    cell = cell_of(tmp_path, lambda *_: Rendering(np.zeros(shape, dtype=np.float32), 0.0))
    assert cell.verdict == Verdict.ERROR
    assert str(shape) in cell.reason
    assert "(4, 6, 3)" in cell.reason


def test_an_image_with_what_is_no_number_is_an_error_and_can_be_read_back(tmp_path: Path) -> None:
    image = np.ones((4, 6, 3), dtype=np.float32)
    image[2, 3, 1] = image[3, 0] = np.nan
    cell = cell_of(tmp_path, lambda *_: Rendering(image, 0.0))
    assert cell.verdict == Verdict.ERROR
    assert cell.reason == "2 pixels of its image are not a number, the first of them (3, 2)"
    read = Cell.model_validate_json((tmp_path / FOLDER / CELL_FILE).read_text())
    assert read.model_dump_json() == cell.model_dump_json()


def test_an_infinite_image_fails(tmp_path: Path) -> None:
    cell = cell_of(tmp_path, lambda *_: Rendering(np.full((4, 6, 3), np.inf, dtype=np.float32), 0.0))
    assert cell.verdict == Verdict.FAIL
    assert cell.judgement is not None
    assert cell.judgement.failing == 24


def test_one_wrong_pixel_fails(tmp_path: Path) -> None:
    def wrong(scene: Scene, folder: Path) -> Rendering:
        image = truthful(scene, folder).image
        image[1, 2, 1] += np.float32(0.01)
        return Rendering(image, 0.0)

    cell = cell_of(tmp_path, wrong)
    assert cell.verdict == Verdict.FAIL
    assert cell.judgement is not None
    assert cell.judgement.worst is not None
    assert (cell.judgement.failing, cell.judgement.worst.x, cell.judgement.worst.y) == (1, 2, 1)
    assert cell.images is not None
    outside = read_image(tmp_path / cell.images.tolerances) > 1
    assert np.argwhere(outside).tolist() == [[1, 2, 1]]  # of the channels, only the wrong one


def test_a_value_that_is_barely_outside_is_still_outside_in_the_map(tmp_path: Path) -> None:
    whole = expectation()
    size = (4, 6, 1, 3)
    feasible = replace(whole.feasible, low=np.full(size, -0.5), high=np.full(size, np.nextafter(0.5, 0)))
    barely = replace(whole, feasible=feasible)
    image = np.full((4, 6, 3), 0.5, dtype=np.float32)
    cell = judged(Pretender(lambda *_: Rendering(image, 0.0)), barely, tmp_path)
    assert cell.verdict == Verdict.FAIL
    assert cell.images is not None
    assert (read_image(tmp_path / cell.images.tolerances) > 1).all()


def test_capped_pixels_are_counted_in_the_reason_and_in_the_kept_evidence(tmp_path: Path) -> None:
    merged = np.zeros((4, 6), dtype=bool)
    merged[1, 2] = merged[3, 0] = True
    for kind, answer in {"lit": truthful, "glass": noisy(0.0, "glass")}.items():
        whole = expectation(kind)
        capped = replace(whole, feasible=replace(whole.feasible, merged=merged))
        cell = judged(Pretender(answer), capped, tmp_path)
        assert cell.verdict == Verdict.PASS
        assert cell.reason.endswith("(2 in a box of several outcomes)")
        assert cell.judgement is not None
        assert cell.judgement.capped == 2
        assert cell.images is not None
        np.testing.assert_array_equal(read_pixel_evidence(tmp_path / cell.images.feasible).merged, merged)


def test_wrong_first_hits_fail_a_right_image(tmp_path: Path) -> None:
    def confused(scene: Scene, folder: Path) -> Rendering:
        nothing = np.full((4, 6), -1)
        nowhere = np.full((4, 6, 3), np.nan)
        hits = FirstHits(np.full((4, 6), np.inf), nowhere, nowhere, nothing)
        return Rendering(truthful(scene, folder).image, 0.0, hits)

    cell = cell_of(tmp_path, confused)
    assert cell.verdict == Verdict.FAIL
    assert cell.first_hits is not None
    assert cell.first_hits.failing > 0
    assert cell.reason == f"{cell.first_hits.failing} of 24 first hits lie outside their feasible sets"


def right_first_hits() -> FirstHits:
    """The middles of the certain feasible sets."""
    feasible = expectation().feasible
    primitive = feasible.hit_primitives[..., 0]
    middles = 0.5 * (feasible.hit_low + feasible.hit_high)[..., 0, :]
    depth = np.where(primitive < 0, np.inf, middles[..., 0])
    return FirstHits(depth, middles[..., 1:4], middles[..., 4:], primitive)


def first_hits_cell(folder: Path, hits: FirstHits | None) -> Cell:
    renderer = Pretender(lambda *_: Rendering(None, 0.5, hits), integrators=FIRST_HITS_ONLY)
    return judged(renderer, expectation(), folder)


def test_first_hits_alone_are_judged_without_an_image(tmp_path: Path) -> None:
    cell = first_hits_cell(tmp_path, right_first_hits())
    assert cell.first_hits is not None
    assert (cell.verdict, cell.reason) == (Verdict.PASS, "all 24 first hits lie in their feasible sets")
    assert (cell.images, cell.judgement, cell.first_hits.compared) == (None, None, 24)
    assert files(tmp_path) == {f"cells/small/pretender-whitted/{CELL_FILE}"}


def test_one_wrong_first_hit_fails_without_an_image(tmp_path: Path) -> None:
    hits = right_first_hits()
    y, x = np.argwhere(hits.primitive >= 0)[0]
    hits.depth[y, x] *= 1 + 1e-6
    cell = first_hits_cell(tmp_path, hits)
    assert (cell.verdict, cell.reason) == (Verdict.FAIL, "1 of 24 first hits lie outside their feasible sets")


def test_first_hits_of_which_none_can_be_judged_do_not_pass(tmp_path: Path) -> None:
    whole = expectation()
    nothing = replace(whole.feasible, hit_primitives=np.full_like(whole.feasible.hit_primitives, UNUSED))
    renderer = Pretender(lambda *_: Rendering(None, 0.5, right_first_hits()), integrators=FIRST_HITS_ONLY)
    cell = judged(renderer, replace(whole, feasible=nothing), tmp_path)
    assert cell.verdict == Verdict.INCOMPARABLE
    assert cell.reason.startswith("24 of 24 first hits cannot be judged")


def test_what_an_integrator_does_not_give_is_an_error(tmp_path: Path) -> None:
    assert first_hits_cell(tmp_path, None).reason == "expected first hits, got nothing"
    only_hits = cell_of(tmp_path, lambda *_: Rendering(None, 0.5, right_first_hits()))
    assert (only_hits.verdict, only_hits.reason) == (Verdict.ERROR, "expected image, got nothing")


@pytest.mark.parametrize("name", ["depth", "position", "normal", "primitive"])
def test_first_hits_of_another_size_are_an_error(name: str, tmp_path: Path) -> None:
    hits = replace(right_first_hits(), **{name: getattr(right_first_hits(), name)[1:]})
    cell = first_hits_cell(tmp_path, hits)
    assert (cell.verdict, cell.reason.startswith(f"expected {name} ")) == (Verdict.ERROR, True)


def test_the_folder_is_replaced_whole(tmp_path: Path) -> None:
    cell_of(tmp_path)
    (tmp_path / FOLDER / "stale.txt").write_text("old")
    cell_of(tmp_path, failing)
    assert {path.name for path in (tmp_path / FOLDER).iterdir()} == {CELL_FILE, "log.txt"}
    assert [path.name for path in (tmp_path / "cells/small").iterdir()] == ["pretender-whitted"]


@pytest.mark.parametrize("unexpected", [ZeroDivisionError, KeyboardInterrupt, MemoryError])
def test_what_nobody_expects_leaves_the_earlier_cell_and_nothing_else(
    unexpected: type[BaseException], tmp_path: Path
) -> None:
    earlier = cell_of(tmp_path)

    def surprising(_scene: Scene, folder: Path) -> Rendering:
        (folder / "half.exr").write_text("half")
        raise unexpected

    with pytest.raises(unexpected):
        cell_of(tmp_path, surprising)
    assert [path.name for path in (tmp_path / "cells/small").iterdir()] == ["pretender-whitted"]
    assert Cell.model_validate_json((tmp_path / FOLDER / CELL_FILE).read_text()) == earlier


@pytest.mark.parametrize("source", ["small", "my scenes/it's; rm -rf $HOME.json", "a\nb.json"])
def test_the_command_repeats_the_cell_whatever_the_path(source: str, tmp_path: Path) -> None:
    cell = cell_of(tmp_path, source=source)
    assert shlex.split(cell.command) == ["raytruth", "run", source, "--renderer", "pretender", "--fresh"]
