from __future__ import annotations

import tomllib
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.grading.assignment_file import (
    AssignmentError,
    assignment_path,
    json_schema,
    load_assignment,
    ready_names,
)
from raytruth.comparisons.grading.assignment_scenes import private_names, scenes_of
from raytruth.scenes.families.catalogue import FAMILIES
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("GRD-1")

RIGHT = """
name = "mine"
title = "Mine"
[[models]]
[[topics]]
id = "one"
title = "One"
scenes = ["single-sphere"]
"""
FAMILY = sorted(FAMILIES)[0]


def problems(folder: Path, text: str) -> list[str]:
    path = folder / "mine.toml"
    path.write_text(text)
    with pytest.raises(AssignmentError) as caught:
        load_assignment(path)
    return [problem.removeprefix(f"{path}: ") for problem in caught.value.problems]


def test_all_mistakes_of_a_file_are_told_at_once_each_with_its_place(tmp_path: Path) -> None:
    told = problems(
        tmp_path,
        RIGHT.replace(
            "[[models]]", "pionts = 3\nfeedback = ['all']\n[[models]]\nepsilon = 1e-3\nrays = { offset = 0.1 }"
        )
        + "scnes = 1\n[[topics]]\nid = 'two'\ntitle = 'Two'\nscenes = ['single-spere']\n"
        "[[topics]]\nid = 'two'\ntitle = 'Two'\n[[stages]]\nid = 'week'\nwithout = ['miror']\n",
    )
    assert [problem.split(": ")[0] for problem in told] == [
        "topics[0].scnes",
        "stages[0].without[0]",
        "feedback[0]",
        "pionts",
        "models[0].epsilon",
        "topics[2].id",
        "topics[2]",
        "topics",
    ]
    assert "did you mean 'points'?" in told[3]
    assert "did you mean 'single-sphere'" in told[-1]


def test_a_file_that_is_none_is_refused_in_one_sentence(tmp_path: Path) -> None:
    (told,) = problems(tmp_path, "name = ")
    assert told.startswith("expected valid TOML")
    with pytest.raises(AssignmentError, match="raytruth grade --init FILE writes one"):
        load_assignment(tmp_path / "none.toml")
    with pytest.raises(AssignmentError, match="did you mean 'shadows'"):
        assignment_path("shadow")


def test_the_schema_has_every_key_of_the_ready_assignments() -> None:
    known = json_schema()["properties"].keys()
    assert ready_names() == ("extremes", "glass", "mirrors", "shadows", "spheres", "whitted")
    for name in ready_names():
        assert tomllib.loads(assignment_path(name).read_text()).keys() <= known


@pytest.mark.parametrize("name", ready_names())
def test_each_ready_assignment_loads_and_is_named_as_its_file(name: str) -> None:
    path = assignment_path(name)
    assignment = load_assignment(path)
    assert assignment.name == name
    assert scenes_of(assignment, path.parent).keys() == {topic.id for topic in assignment.topics}


def test_a_stage_leaves_out_what_is_not_due_and_a_seed_draws_other_scenes() -> None:
    path = assignment_path("whitted")
    whitted = load_assignment(path)
    due = scenes_of(whitted, path.parent, stage=whitted.stages[0])
    features = frozenset[str]().union(*(required_features(scene) for scenes in due.values() for scene in scenes))
    assert features.isdisjoint({"MIRRORS", "DIELECTRICS"})
    assert due.keys() == {"shading", "shadows", "whole"}
    path = assignment_path("shadows")
    shadows = load_assignment(path)
    first, second = (scenes_of(shadows, path.parent, seed)["drawn"] for seed in (0, 7))
    assert {scene.name for scene in first}.isdisjoint(scene.name for scene in second)
    assert first[0].objects != second[0].objects


def test_the_first_attempts_may_be_told_less(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(RIGHT.replace("[[models]]", "feedback = ['score', 'topics']\n[[models]]"))
    assignment = load_assignment(path)
    assert [assignment.told(attempt) for attempt in (1, 2, 3)] == ["score", "topics", "topics"]


def with_keys(text: str) -> str:
    return RIGHT.replace("[[models]]", f"{text}\n[[models]]")


def test_dates_alter_what_is_told_from_then_on_whichever_attempt_it_is(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    dated = """
    [[dated_feedback]]
    since = 2026-12-08T00:00:00Z
    told = "diagnosis"
    [[dated_feedback]]
    since = 2026-12-01T00:00:00+01:00
    told = "scenes"
    """
    path.write_text(with_keys("feedback = ['score', 'topics']" + dated))
    assignment = load_assignment(path)
    first, second = (datetime(2026, 12, day, tzinfo=UTC) for day in (1, 8))
    before = datetime(2026, 11, 30, 22, 59, tzinfo=UTC)
    assert [assignment.told(2, date) for date in (None, before, first, second)] == [
        "topics",
        "topics",
        "scenes",
        "diagnosis",
    ]


def test_private_scenes_are_graded_and_told_after_the_deadline(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    drawn = "[[topics.families]]\nfamily = 'spheres'\nparameter = 3.0\nseeds = [1]\nprivate_seeds = [5, 6]\n"
    text = with_keys("deadline = 2026-12-01T00:00:00Z\ndrawn = 'anew'") + "private_scenes = ['single-plane']\n" + drawn
    path.write_text(text.replace("'spheres'", f"'{FAMILY}'"))
    assignment = load_assignment(path)
    for seed in (0, 7):
        names = {scene.name for scene in scenes_of(assignment, tmp_path, seed)["one"]}
        private = private_names(assignment, seed)
        assert private == {"single-plane", *(f"{FAMILY}-3-{seed + own}" for own in (5, 6))}
        assert names - private == {"single-sphere", f"{FAMILY}-3-{seed + 1}"}
    deadline = datetime(2026, 12, 1, tzinfo=UTC)
    told = [assignment.tells_private(date) for date in (None, deadline - timedelta(seconds=1), deadline)]
    assert told == [False, False, True]


def test_what_does_not_go_together_is_told_at_once(tmp_path: Path) -> None:
    told = problems(
        tmp_path,
        with_keys("deadline = 2026-12-01T00:00:00\ndrawn = 'anew'\ndated_feedback = [{ since = 'soon', told = 'al' }]")
        + "private_scenes = ['single-plane']\n",
    )
    assert [problem.split(": ")[0] for problem in told] == [
        "dated_feedback[0].since",
        "dated_feedback[0].told",
        "deadline",
        "drawn",
    ]
    assert "without quotes" in told[0]
    assert "expected a date with its offset from UTC, as 2026-12-01T00:00:00+01:00" in told[2]
    assert "expected families" in told[3]
    (told_of_topic,) = problems(tmp_path, f"{RIGHT}private_scenes = ['single-plane']\n")
    assert told_of_topic.startswith("topics[0]: expected a deadline beside private scenes")
    (told_of_family,) = problems(tmp_path, f"{RIGHT}[[topics.families]]\nfamily = '{FAMILY}'\nparameter = 3.0\n")
    assert told_of_family == "topics[0].families[0]: expected seeds or private_seeds, found neither."
