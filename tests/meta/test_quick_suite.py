"""The suite kills what it says: every fault of the catalogue, by the quick suite alone, and no right renderer."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.faults.variants import all_variants
from raytruth.comparisons.kills.kill_matrix import kills_on
from raytruth.comparisons.matrix.quick_suite import quick_scenes
from raytruth.scenes.library import library_names, open_scene

pytestmark = pytest.mark.clause("VER-12")

PAGE = (Path(__file__).parents[2] / "docs" / "kill-matrix.md").read_text(encoding="utf-8")
# Triangles with a tree of boxes, several kinds of lights, mirrors: cheap scenes that between them need most functions.
CHEAP = ("cornell-box", "several-lights-sphere", "blinn-sphere", "coloured-mirrors", "camera-in-tea")


def test_the_quick_suite_kills_every_fault_of_the_catalogue() -> None:
    left = dict(all_faults())
    for name in quick_scenes():
        for cell in kills_on(open_scene(name), left.values()).cells:
            if cell.fails:
                del left[cell.subject]
    assert list(left) == []


@pytest.mark.parametrize("name", CHEAP)
def test_no_legitimate_variant_is_flagged(name: str) -> None:
    cells = kills_on(open_scene(name), all_variants().values()).cells
    assert [(cell.subject, cell.margin, cell.error) for cell in cells if cell.fails] == []


def test_the_documented_kill_matrix_is_that_of_the_catalogue() -> None:
    rows = re.findall(r"^\| ([^|]+) \| ([A-Z]+-\d+) \| ([^|]+) \| (\d+) of \d+ \| \S+ \|$", PAGE, re.MULTILINE)
    assert [(name, clause, words) for name, clause, words, _ in rows] == [
        (fault.name.replace("_", " "), fault.clause, fault.words) for fault in all_faults().values()
    ]
    assert all(int(kills) > 0 for *_, kills in rows)
    assert f"{len(rows)} of {len(rows)} faults are killed by {len(library_names())} scenes; 0 of" in PAGE
    variants = re.findall(r"^\| ([^|]+) \| ([^|]+) \| (\S+) \|$", PAGE, re.MULTILINE)
    assert {(name, words) for name, words, _ in variants} >= {(v.name, v.words) for v in all_variants().values()}
