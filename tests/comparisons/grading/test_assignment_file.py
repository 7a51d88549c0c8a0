from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.grading.assignment_file import (
    AssignmentError,
    assignment_path,
    json_schema,
    load_assignment,
    ready_names,
)
from raytruth.comparisons.grading.assignment_scenes import scenes_of
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
