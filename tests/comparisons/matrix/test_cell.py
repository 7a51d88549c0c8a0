from __future__ import annotations

import shlex
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.feasible_sets.feasible_set import UNUSED, feasible_set
from raytruth.comparisons.judgement.exact_test import UNJUDGED
from raytruth.comparisons.judgement.verdict import Evidence, gather_evidence
from raytruth.comparisons.matrix.cell import CELL_FILE, run_cell
from raytruth.comparisons.noise.lobes import find_lobes
from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.pixel_evidence import pixel_evidence, read_pixel_evidence
from raytruth.comparisons.records.renderings import FirstHits, RendererError, Rendering
from raytruth.comparisons.records.results import Cell, Verdict
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from tests.comparisons.matrix.cell_places import place_of
from tests.comparisons.matrix.pretending import Pretender, truthful
from tests.reference_tracer.small_scenes import lamp, small_scene

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.scenes.scene import Scene

    Answer = Callable[[Scene, Path], Rendering]

pytestmark = pytest.mark.clause("VER-3", "VER-4", "VER-9", "VER-10", "REN-1")

FOLDER = "cells/small/pretender-whitted"
FIRST_HITS_ONLY = (Integrator("whitted", "E", gives="first hits"),)
GLASS = {"white": {"dielectric": {"index_of_refraction": 1.5}}}
SIZE: dict[str, Any] = {"width": 6, "height": 4, "extent": 3.0}
# Brighter overhead than anything in the picture, so that right means are not at their bound.
SKY = {"bottom": (0.2, 0.2, 0.2), "top": (0.9, 0.9, 0.9)}


@cache
def evidence(kind: str = "lit") -> Evidence:
    kinds: dict[str, dict[str, Any]] = {
        "lit": {"lights": [lamp((1.0, 2.0, 3.0))]},
        "glass": {"materials": GLASS, "background": SKY, "max_depth": 2},
        "dark glass": {"materials": GLASS, "max_depth": 2},
    }
    scene = small_scene(**SIZE, **kinds[kind])
    truth = np.asarray(render(scene, FLOAT), dtype=np.float64)
    return gather_evidence(scene, truth, feasible_set(scene, Pretender().error_model))


def cell_of(folder: Path, answer: Answer = truthful, kind: str = "lit", source: str = "small") -> Cell:
    return judged(Pretender(answer), evidence(kind), folder, source)


def judged(renderer: Pretender, by: Evidence, folder: Path, source: str = "small") -> Cell:
    return run_cell(place_of(by.scene, renderer, "whitted", source=source), 1, by, folder)


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
    np.testing.assert_array_equal(read_image(tmp_path / cell.images.render), evidence().truth.astype(np.float32))
    assert read_image(tmp_path / cell.images.tolerances).max() <= 1
    kept = read_pixel_evidence(tmp_path / cell.images.feasible)
    exact = evidence().feasible
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
    whole = evidence()
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
        whole = evidence(kind)
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
    assert cell.reason.startswith(f"{cell.first_hits.failing} first hits")


def right_first_hits() -> FirstHits:
    """The middles of the certain feasible sets."""
    feasible = evidence().feasible
    primitive = feasible.hit_primitives[..., 0]
    middles = 0.5 * (feasible.hit_low + feasible.hit_high)[..., 0, :]
    depth = np.where(primitive < 0, np.inf, middles[..., 0])
    return FirstHits(depth, middles[..., 1:4], middles[..., 4:], primitive)


def first_hits_cell(folder: Path, hits: FirstHits | None) -> Cell:
    renderer = Pretender(lambda *_: Rendering(None, 0.5, hits), integrators=FIRST_HITS_ONLY)
    return judged(renderer, evidence(), folder)


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
    whole = evidence()
    nothing = replace(whole.feasible, hit_primitives=np.full_like(whole.feasible.hit_primitives, UNUSED))
    renderer = Pretender(lambda *_: Rendering(None, 0.5, right_first_hits()), integrators=FIRST_HITS_ONLY)
    cell = judged(renderer, replace(whole, feasible=nothing), tmp_path)
    assert (cell.verdict, "no first hit could be judged" in cell.reason) == (Verdict.FAIL, True)


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


def noisy(offset: float, kind: str) -> Answer:
    """Batches of many samples of which the mean is off by a part of the truth."""

    def answer(_scene: Scene, _folder: Path) -> Rendering:
        mean = evidence(kind).truth * (1 + offset)
        noise = np.where(find_lobes(evidence(kind).scene).sees_directly(), 0.0, 0.01)[..., np.newaxis]
        batches = np.stack([mean * (1 + sign * noise) for sign in (-1, 1) * 8]).astype(np.float32)
        return Rendering(mean.astype(np.float32), 1.0, samples=16 * 10_000, batch_means=batches)

    return answer


def test_a_noisy_mean_is_tested_and_its_variance_kept(tmp_path: Path) -> None:
    right = cell_of(tmp_path, noisy(0.0, "glass"), "glass")
    assert right.verdict == Verdict.PASS, right.reason
    assert right.stochastic is not None
    assert (right.stochastic.samples, right.stochastic.batches) == (160_000, 16)
    assert right.images is not None
    assert right.images.variance is not None
    assert read_image(tmp_path / right.images.variance).max() > 0
    kept = read_pixel_evidence(tmp_path / right.images.feasible)
    low, high = evidence("glass").feasible.hull()
    assert kept.low.shape == (4, 6, 1, 3)  # one interval, in which the expectation lies
    np.testing.assert_allclose(kept.low[:, :, 0], np.maximum(low, 0), atol=1e-6)
    np.testing.assert_allclose(kept.high[:, :, 0], high, atol=1e-6)
    wrong = cell_of(tmp_path, noisy(-0.1, "glass"), "glass")
    assert wrong.verdict == Verdict.FAIL
    assert wrong.judgement is not None
    assert wrong.judgement.failing > 0


def test_glass_in_the_dark_is_black(tmp_path: Path) -> None:
    assert cell_of(tmp_path, noisy(0.0, "dark glass"), "dark glass").verdict == Verdict.PASS

    def bright(_scene: Scene, _folder: Path) -> Rendering:
        image = np.full((4, 6, 3), 0.5, dtype=np.float32)
        return Rendering(image, 1.0, samples=160, batch_means=np.stack([image] * 4))

    assert cell_of(tmp_path, bright, "dark glass").verdict == Verdict.FAIL


def test_a_noisy_image_of_which_nothing_can_be_judged_fails(tmp_path: Path) -> None:
    whole = evidence("glass")
    nowhere = np.full_like(whole.feasible.low, np.nan)
    blind = replace(whole.feasible, low=nowhere, high=nowhere)
    unjudged = replace(whole, feasible=blind)
    cell = judged(Pretender(noisy(0.0, "glass")), unjudged, tmp_path)
    assert cell.verdict == Verdict.FAIL
    assert "no pixel could be judged" in cell.reason


@pytest.mark.parametrize(("factor", "failing_pixels"), [(1.0, 0), (100.0, 1)])
def test_an_unjudged_pixel_of_a_noisy_image_is_held_to_the_brightest_there_can_be(
    factor: float, failing_pixels: int, tmp_path: Path
) -> None:
    whole = evidence("glass")
    low, high = whole.feasible.low.copy(), whole.feasible.high.copy()
    low[0, 0] = high[0, 0] = np.nan  # a corner that looks past the glass
    unjudged = replace(whole, feasible=replace(whole.feasible, low=low, high=high))

    def answer(scene: Scene, folder: Path) -> Rendering:
        rendering = noisy(0.0, "glass")(scene, folder)
        assert rendering.batch_means is not None
        rendering.batch_means[:, 0, 0] *= np.float32(factor)
        return rendering

    cell = judged(Pretender(answer), unjudged, tmp_path)
    assert cell.judgement is not None
    assert cell.images is not None
    assert (cell.judgement.unjudged, cell.judgement.failing) == (1, failing_pixels)
    assert cell.verdict == (Verdict.FAIL if failing_pixels else Verdict.PASS)
    assert cell.reason.endswith("(1 not judged)")
    distance = read_image(tmp_path / cell.images.tolerances)[0, 0]
    assert (distance.max() > 1) if failing_pixels else (distance == UNJUDGED).all()


@pytest.mark.parametrize("source", ["small", "my scenes/it's; rm -rf $HOME.json", "a\nb.json"])
def test_the_command_repeats_the_cell_whatever_the_path(source: str, tmp_path: Path) -> None:
    cell = cell_of(tmp_path, source=source)
    assert shlex.split(cell.command) == ["raytruth", "run", source, "--renderer", "pretender", "--fresh"]
