"""What docs/scene-format.md tells about mesh files and limits is what loading does."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from raytruth.scenes import camera, consistency, loading, mesh_files, obj_file, ply_header, scene, values
from raytruth.scenes.triangle_lists import LARGEST_FACE_COUNT

pytestmark = pytest.mark.clause("SCN-4")

MANUAL = (Path(__file__).parents[2] / "docs" / "scene-format.md").read_text(encoding="utf-8")
SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
MEBIBYTE = 2**20


def keywords_after(sentence: str) -> set[bytes]:
    """The words in backticks from a sentence of the manual to the end of its list item."""
    item = MANUAL.partition(f"- {sentence}")[2].partition("\n- ")[0].partition("\n\n")[0]
    return {word.encode() for word in re.findall(r"`(\w+)`", item)}


def test_the_manual_names_every_keyword_of_obj_that_is_read_past_or_refused() -> None:
    assert keywords_after("Keywords that are read past") == obj_file._READ_PAST
    assert keywords_after("Keywords that are refused") == obj_file._REFUSED.keys()


def test_the_manual_names_every_type_of_ply() -> None:
    grammar = MANUAL.partition("whole type    =")[2].partition("name          =")[0]
    assert {word.encode() for word in re.findall(r"'(\w+)'", grammar)} == ply_header._TYPE_CODES.keys()


def numbers_of(limit: str) -> list[float]:
    """10¹², 2²⁴, 500,000 and 64 in words."""
    powers = re.findall(r"(\d+)([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)", limit)
    if powers:
        return [float(base) ** int(exponent.translate(SUPERSCRIPTS)) for base, exponent in powers]
    return [float(number.replace(",", "")) for number in re.findall(r"[\d,]*\d", limit)]


LIMITS = {
    "a number of a scene, or a coordinate of a mesh file": [values.LARGEST_COORDINATE],
    "the largest component of a direction": [values.SHORTEST_DIRECTION],
    "the sine of the angle between `up` and the view": [consistency.SMALLEST_SINE],
    "`index_of_refraction`": [values.SMALLEST_INDEX, 1 / values.SMALLEST_INDEX],
    "`vertical_field_of_view`": [0, 180],
    "`width`, `height`": [1, camera.LARGEST_SIDE],
    "`width` times `height`": [consistency.LARGEST_PIXEL_COUNT],
    "`max_depth`": [0, scene.LARGEST_DEPTH],
    "triangles in all meshes": [LARGEST_FACE_COUNT],
    "mesh files of a scene": [loading.MOST_MESH_FILES],
    "a mesh file": [mesh_files.LARGEST_MESH_FILE / MEBIBYTE],
    "rows of an element of PLY": [ply_header._MOST_ROWS],
    "a scene file": [loading.LARGEST_SCENE_FILE / MEBIBYTE],
}


def test_the_manual_tells_every_limit() -> None:
    table = MANUAL.partition("## Limits")[2]
    rows = dict(re.findall(r"^\| (?!what|---)(.+?) \| (.+?) \| .+ \|$", table, flags=re.MULTILINE))
    assert {what: numbers_of(limit) for what, limit in rows.items()} == {
        what: pytest.approx(limits, rel=1e-12) for what, limits in LIMITS.items()
    }
