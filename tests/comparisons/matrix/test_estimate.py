from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from raytruth.comparisons.matrix.estimate import Pace, cells_seconds, kept_pace, truth_seconds
from tests.comparisons.matrix.runs import plan
from tests.comparisons.matrix.scene_files import scene_file

if TYPE_CHECKING:
    from pathlib import Path

    from tests.comparisons.matrix.pretending import Pretender

pytestmark = pytest.mark.clause("RES-6")


def test_what_is_kept_takes_no_time(pretender: Pretender, tmp_path: Path) -> None:
    cells = plan(pretender, [scene_file(tmp_path)], tmp_path / "out").cells
    before = truth_seconds(cells), cells_seconds(cells)
    kept_feasible_set(cells[0].place.scene, cells[0].error_model)
    assert truth_seconds(cells) == 0 < before[0]
    assert 0 < cells_seconds(cells) < before[1]


def test_larger_scenes_take_longer(pretender: Pretender, tmp_path: Path) -> None:
    small, large = (
        plan(pretender, [scene_file(tmp_path, name, width=width)], tmp_path / "out").cells
        for name, width in (("small", 4), ("large", 400))
    )
    assert truth_seconds(small) < truth_seconds(large)
    assert cells_seconds(small) < cells_seconds(large)


@pytest.mark.usefixtures("pretender")  # for its empty cache
def test_what_was_measured_corrects_the_estimate_and_is_kept_for_the_next_run() -> None:
    pace = kept_pace()
    assert pace.seconds(100) == 100
    pace.note(1000, 100)
    assert 10 < pace.seconds(100) < 15
    pace.keep()
    assert kept_pace().seconds(100) == pytest.approx(pace.seconds(100))


@pytest.mark.usefixtures("pretender")
def test_a_short_run_changes_little_and_a_long_one_much() -> None:
    Pace(estimated=1e6, measured=1e6).keep()
    short, long = kept_pace(), kept_pace()
    short.note(3, 300)
    long.note(3000, 300_000)
    assert short.seconds(100) < 130
    assert long.seconds(100) > 5000


@pytest.mark.usefixtures("pretender")
@pytest.mark.parametrize("text", ["", "1", "1 2 3", "a b", "0 1", "1 -1", "nan 1", "1 inf"])
def test_a_damaged_measurement_is_ignored(text: str, tmp_path: Path) -> None:
    Pace().keep()
    (path,) = (tmp_path / "cache" / "pace").iterdir()
    path.write_text(text)
    assert kept_pace() == Pace()
