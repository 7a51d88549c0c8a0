from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from raytruth.comparisons.judgement.exact_test import UNJUDGED
from raytruth.comparisons.records.image_files import read_image
from raytruth.comparisons.records.pixel_evidence import read_pixel_evidence
from raytruth.comparisons.records.renderings import Rendering
from raytruth.comparisons.records.results import Verdict
from tests.comparisons.matrix.pretending import Pretender
from tests.comparisons.matrix.small_cells import cell_of, expectation, judged, noisy

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("VER-3", "VER-4", "VER-9", "VER-10", "REN-1")


def test_a_noisy_mean_is_tested_and_its_variance_kept(tmp_path: Path) -> None:
    right = cell_of(tmp_path, noisy(0.0, "glass"), "glass")
    assert right.verdict == Verdict.PASS, right.reason
    assert right.stochastic is not None
    assert (right.stochastic.samples, right.stochastic.batches) == (160_000, 16)
    assert right.images is not None
    assert right.images.variance is not None
    assert read_image(tmp_path / right.images.variance).max() > 0
    kept = read_pixel_evidence(tmp_path / right.images.feasible)
    low, high = expectation("glass").feasible.hull()
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


def test_a_noisy_image_of_which_nothing_can_be_judged_does_not_pass(tmp_path: Path) -> None:
    whole = expectation("glass")
    nowhere = np.full_like(whole.feasible.low, np.nan)
    blind = replace(whole.feasible, low=nowhere, high=nowhere)
    unjudged = replace(whole, feasible=blind)
    cell = judged(Pretender(noisy(0.0, "glass")), unjudged, tmp_path)
    assert cell.verdict == Verdict.INCOMPARABLE
    assert "pixels cannot be judged" in cell.reason


@pytest.mark.parametrize(("factor", "failing_pixels"), [(1.0, 0), (100.0, 1)])
def test_an_unjudged_pixel_of_a_noisy_image_is_held_to_the_brightest_there_can_be(
    factor: float, failing_pixels: int, tmp_path: Path
) -> None:
    whole = expectation("glass")
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
    # One of so few is more than one in a hundred.
    assert cell.verdict == (Verdict.FAIL if failing_pixels else Verdict.INCOMPARABLE)
    assert ("(1 not judged)" in cell.reason) == bool(failing_pixels)
    distance = read_image(tmp_path / cell.images.tolerances)[0, 0]
    assert (distance.max() > 1) if failing_pixels else (distance == UNJUDGED).all()


@pytest.mark.clause("VER-16")
def test_what_is_not_due_at_all_is_declared_also_where_it_is_black(tmp_path: Path) -> None:
    by = expectation("dark glass")
    departing = replace(by, feasible=replace(by.feasible, due=np.zeros_like(by.feasible.due)), truth=by.truth + 0.5)
    cell = judged(Pretender(noisy(0.0, "dark glass")), departing, tmp_path)
    assert cell.verdict == Verdict.DECLARED, cell.reason
