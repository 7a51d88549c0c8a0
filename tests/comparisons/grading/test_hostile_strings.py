"""Strings of a submission with script, control characters and a megabyte of name, wherever it may put them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.grading.feedback import for_student
from raytruth.comparisons.grading.submission import submitted
from raytruth.comparisons.records.grade_results import Grade, SceneGrade
from raytruth.comparisons.renderers.program.declaration_file import DeclarationError, checked_declaration
from raytruth.reports.grade_junit import grade_junit
from raytruth.reports.grade_pages import grade_page
from raytruth.reports.grade_text import grade_lines
from raytruth.reports.gradescope import gradescope_results
from raytruth.reports.wording import printable
from tests.comparisons.renderers.program.scripts import grey_scene, program

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REP-2", "GRD-6")

SCRIPT, CONTROL = "<script>alert(1)</script>", "\x1b[31m\x07"
MEGABYTE = 1 << 20
# As much as a page can hold of one scene: 64 channels of a picture, each with the 255 characters that OpenEXR allows.
LONGEST = 20_000

# A picture in OpenEXR with channels of these names, which no library would write.
EXR = """
def attribute(name, kind, value):
    return name + b"\\0" + kind + b"\\0" + struct.pack("<i", len(value)) + value
window = struct.pack("<4i", 0, 0, width - 1, height - 1)
channels = b"".join(name + b"\\0" + struct.pack("<4i", 2, 0, 1, 1) for name in NAMES) + b"\\0"
header = struct.pack("<2i", 20000630, 2 | 0x400) + attribute(b"channels", b"chlist", channels)
header += attribute(b"compression", b"compression", b"\\0") + attribute(b"lineOrder", b"lineOrder", b"\\0")
header += attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window)
header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\\0"
open(output, "wb").write(header + bytes(100_000))
"""
PLACES = {
    "its output": (f"sys.exit({SCRIPT + CONTROL!r} + 'A' * {MEGABYTE} + {SCRIPT + CONTROL!r})", "pfm"),
    "names of files": (f"os.mkdir({SCRIPT.replace('/', '')!r}); open('A' * 255, 'w'); open({CONTROL!r}, 'w')", "pfm"),
    "a header of PFM": (f"open(output, 'wb').write(b'PF {SCRIPT}' + b'A' * {MEGABYTE})", "pfm"),
    "names of channels": (f"NAMES = [{(SCRIPT + CONTROL).encode()!r}, b'B', b'G']{EXR}", "exr"),
    "a megabyte of a channel's name": (f"NAMES = [b'A' * {MEGABYTE}, b'B', b'G']{EXR}", "exr"),
}


@pytest.mark.parametrize("place", PLACES)
def test_no_string_of_a_submission_becomes_markup_or_control_or_fills_a_page(place: str, tmp_path: Path) -> None:
    code, format_name = PLACES[place]
    problem = submitted(program(tmp_path, code, writes=format_name), grey_scene()).problem
    assert 0 < len(problem) < LONGEST
    assert "\n" not in problem
    graded = Grade(
        raytruth_version="1",
        assignment="mine",
        title="Mine",
        submission="mine",
        stage=None,
        attempt=1,
        told="diagnosis",
        status="graded",
        score=0.0,
        maximum=1.0,
        clauses=(),
        mistakes=(),
        scenes=(SceneGrade(name="small", purpose="-", verdict="error", credit=0.0, reason=problem),),
        diagnosis=(),
        seconds=1.0,
    )
    told = for_student(graded)
    pages = [grade_page(told, for_teacher=False), grade_page(graded, for_teacher=True), grade_junit(told).decode()]
    for text in [*pages, gradescope_results(told), printable("\n".join(grade_lines(told)))]:
        assert CONTROL[0] not in text
        assert CONTROL[-1] not in text
    assert not any(SCRIPT in page for page in pages)


def test_a_name_of_a_megabyte_is_refused_in_a_short_sentence() -> None:
    data = {"name": "a" * MEGABYTE, "command": ["./tracer", "{scene}", "{output}"]}
    with pytest.raises(DeclarationError) as raised:
        checked_declaration(data, "mine.toml")
    assert len(str(raised.value)) < 1000
