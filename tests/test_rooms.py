"""Imports go one way, from room to room, and in no cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.rooms import ROOMS, ROOT, import_graph, imported_names, levels, module_of, room_of, sources

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-1")

PATHS = {module_of(path): path for path in sources()}

# A report reads what others wrote down, and knows nothing of how it came about.
RECORDS = (
    "raytruth.comparisons.records",
    "raytruth.reference_tracer.explanation_record",
    "raytruth.reference_tracer.storage.whole_files",
)
# The physics reads like a textbook: it knows neither scenes nor arithmetics.
ALONE = {"scenes", "reference_tracer/source", "reference_tracer/storage"}


def relative(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


@pytest.mark.parametrize("path", sources(), ids=relative)
def test_a_file_imports_from_its_own_room_and_from_rooms_above_it(path: Path) -> None:
    room = room_of(path)
    above = {room} if room in ALONE else {*ROOMS[: ROOMS.index(room)], room}
    rooms = {room_of(PATHS[module]) for module in import_graph()[module_of(path)]}
    assert rooms <= above


@pytest.mark.parametrize("path", [path for path in sources() if room_of(path) == "reports"], ids=relative)
def test_a_report_knows_records_only(path: Path) -> None:
    ours = {name for name in imported_names(path) if name.startswith("raytruth.")}
    assert [name for name in ours if not name.startswith(("raytruth.reports", *RECORDS))] == []


def test_no_source_imports_a_test() -> None:
    assert [path for path in sources() if any(name.startswith("tests") for name in imported_names(path))] == []


def test_every_room_holds_files_and_every_file_lies_in_a_room() -> None:
    assert {room_of(path) for path in sources()} == set(ROOMS)


def test_no_modules_import_one_another() -> None:
    assert set(levels(import_graph())) == set(PATHS)


def test_a_cycle_is_found() -> None:
    assert levels({"a": frozenset(), "b": frozenset({"a"})}) == {"a": 1, "b": 2}
    with pytest.raises(ValueError, match="import one another: b, c"):
        levels({"a": frozenset(), "b": frozenset({"a", "c"}), "c": frozenset({"b"})})


def test_tests_lie_in_the_folders_of_what_they_test() -> None:
    tested = {path for path in (ROOT / "tests").rglob("test_*.py") if len(path.relative_to(ROOT).parts) > 2}
    folders = {path.parent.relative_to(ROOT / "tests") for path in tested}
    by_purpose = {"properties", "extremes", "second_opinion", "meta", "browser"}
    assert [folder for folder in folders if folder.parts[0] not in by_purpose and not (ROOT / folder).is_dir()] == []
