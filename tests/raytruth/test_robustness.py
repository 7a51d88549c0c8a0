"""Whatever is broken around it, a command does what is right or ends in one sentence, and never in a traceback."""

from __future__ import annotations

import json
import os
import shutil
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from raytruth import command_line, run_command
from raytruth.comparisons.matrix import run as matrix_run
from raytruth.comparisons.records.results import RESULTS_FILE, Results
from tests.comparisons.matrix.scene_files import scene_file
from tests.raytruth.running import refusal, run, run_apart

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "RES-2")

CELL = "cells/small/closed_form-local"
IMAGES = (f"{CELL}/render.exr", f"{CELL}/tolerances.exr", f"{CELL}/feasible.exr", "cells/small/truth.exr")
# Each example is a whole run, which takes up to a second.
a_run_each = settings(max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working directory, with two tiny scenes that have run; scenes are rendered in this process."""
    monkeypatch.setattr(matrix_run, "ProcessPoolExecutor", lambda jobs, *_: ThreadPoolExecutor(jobs))
    # Global metrics are measured in the tests of closed_form; each process that measures them takes a second to start.
    monkeypatch.setattr(run_command, "with_metrics", lambda _out, cells: cells)
    monkeypatch.chdir(tmp_path)
    for name in ("small", "other"):
        scene_file(tmp_path, name)
    return tmp_path


@pytest.fixture
def finished(folder: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """A results directory with the cells of both."""
    assert run(capsys, "run", "small.json", "other.json", "--renderer", "closed_form")[0] == 0
    return folder / "results"


def results_in(directory: Path) -> dict[str, Any]:
    """All but when and by which command they were written."""
    results = Results.model_validate_json((directory / RESULTS_FILE).read_bytes())
    return results.model_dump(mode="json", exclude={"created", "command"})


def flipped(content: bytes, place: int, bit: int) -> bytes:
    """The content with one bit turned round."""
    return content[:place] + bytes([content[place] ^ 1 << bit]) + content[place + 1 :]


DAMAGES = (
    lambda content, place, _: content[:place],
    flipped,
    lambda *_: b"{}",
    lambda *_: b"[" * 100_000,
    lambda *_: b'{"schema_version": 1, "cells": [{"scene": "\\ud800"}]}',
    lambda content, *_: content.replace(b'"small"', b'"smell"', 1),
)


@st.composite
def damages(draw: st.DrawFn) -> Callable[[bytes], bytes]:
    """A function that damages the content of a file."""
    kind, bit = draw(st.sampled_from(DAMAGES)), draw(st.integers(0, 7))
    place = draw(st.floats(0, 1, exclude_max=True))
    return lambda content: kind(content, int(place * len(content)), bit)


@a_run_each
@given(damage=damages())
def test_a_damaged_record_of_results_is_made_again_without_rendering_anything(
    damage: Callable[[bytes], bytes], finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = results_in(finished)
    record = finished / RESULTS_FILE
    whole = record.read_bytes()
    record.write_bytes(damage(whole))
    status, _, err = run(capsys, "run", "small.json", "other.json", "--renderer", "closed_form")
    assert (status, "closed_form local:" in err, "Traceback" in err) == (0, False, False)
    assert results_in(finished) == before
    record.write_bytes(whole)


@pytest.mark.parametrize("content", [b"", b"{", b"[]", None])
def test_a_run_of_one_scene_loses_no_cell_of_another(
    content: bytes | None, finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = results_in(finished)
    (finished / RESULTS_FILE).unlink() if content is None else (finished / RESULTS_FILE).write_bytes(content)
    _, _, err = run(capsys, "run", "small.json", "--renderer", "closed_form")
    (told,) = [line for line in err.splitlines() if "results.json" in line]
    assert f"is {'missing' if content is None else 'damaged'}: 2 cells are taken over from the files" in told
    assert results_in(finished) == before


def test_a_cell_of_a_scene_and_a_renderer_that_are_gone_is_kept(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    old = finished / CELL
    for path in ("cells/other/closed_form-local", "cells/gone/unheard_of-local"):
        shutil.copytree(old, finished / path, dirs_exist_ok=True)
    cell = json.loads((old / "cell.json").read_text(encoding="utf-8"))
    changed = cell | {"scene": "gone", "renderer": "unheard_of", "source": "gone.json"}
    (finished / "cells/gone/unheard_of-local/cell.json").write_text(json.dumps(changed), encoding="utf-8")
    (finished / RESULTS_FILE).write_text("{", encoding="utf-8")
    assert run(capsys, "run", "small.json", "--renderer", "closed_form")[0] == 0
    results = Results.model_validate_json((finished / RESULTS_FILE).read_bytes())
    # The folder of `other` now holds a cell of another name, which is nobody's.
    assert [(cell.scene, cell.renderer) for cell in results.cells] == [("gone", "unheard_of"), ("small", "closed_form")]
    assert run(capsys, "report", str(finished))[0] == 0


@a_run_each
@given(image=st.sampled_from(IMAGES), damage=damages(), is_missing=st.booleans())
def test_a_cell_with_a_missing_or_damaged_image_runs_again(
    image: str, damage: Callable[[bytes], bytes], is_missing: bool, finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before, whole = results_in(finished), (finished / image).read_bytes()
    damaged = damage(whole)
    (finished / image).unlink() if is_missing else (finished / image).write_bytes(damaged)
    status, _, err = run(capsys, "run", "small.json", "other.json", "--renderer", "closed_form")
    assert status == 0
    assert ("[1/1] small closed_form local: pass" in err) == (is_missing or damaged != whole)
    assert (finished / image).read_bytes() == whole
    after = results_in(finished)
    for results in (before, after):
        for cell in results["cells"]:
            cell.pop("seconds")
    assert after == before


@pytest.mark.parametrize("place", ["a file", "a folder under a file"])
def test_a_cache_that_cannot_be_written_stops_nobody_and_is_told_once(place: str, tmp_path: Path) -> None:
    scene = scene_file(tmp_path)
    (tmp_path / "file").write_text("no folder", encoding="utf-8")
    cache = tmp_path / "file" if place == "a file" else tmp_path / "file" / "cache"
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    environment = {**os.environ, "RAYTRUTH_CACHE": str(cache), "TMPDIR": str(temporary)}
    commands = [
        ["truth", scene, "--jobs", "2"],
        ["run", scene, "--renderer", "closed_form", "--jobs", "2"],
        ["render", scene, "-o", "picture.png"],
    ]
    for arguments in commands if place == "a file" else commands[:1]:
        done = run_apart(tmp_path, *arguments, env=environment)
        assert (done.returncode, done.stderr.count("nothing is kept for the next run")) == (0, 1), done.stderr
        assert f"the cache folder {cache} cannot be written: " in done.stderr
    assert [path for path in temporary.iterdir() if path.name.startswith("raytruth-cache-")] == []


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("run", "small.json", "--out", "small.json"), "--out: expected a folder, but small.json is a file."),
        (("run", "--quick", "--out", "small.json"), "--out: expected a folder, but small.json is a file."),
        (("run", "small.json", "--out", "small.json/in"), "small.json/in: Not a directory."),
        (("faults", "small.json", "--out", "small.json"), "--out: expected a folder, but small.json is a file."),
        (("truth", "small.json", "--out", "small.json"), "--out: expected a folder, but small.json is a file."),
        (("run", "small.json", "--renderer", ""), "--renderer: expected the name of a renderer, found none"),
        (("run", "small.json", "--renderer", " , "), "--renderer: expected the name of a renderer, found none"),
        (("run", "small.json", "--require", ""), "--require: expected the name of a renderer, found none"),
    ],
)
@pytest.mark.usefixtures("folder")
def test_an_option_that_names_nothing_usable_is_one_sentence(
    arguments: tuple[str, ...], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert told in refusal(capsys, *arguments)


def test_a_report_that_cannot_be_written_is_one_sentence_and_the_results_stay(
    finished: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (finished / "report.html").unlink()
    (finished / "report.html").mkdir()
    for command in (("run", "small.json", "--renderer", "closed_form"), ("report", "results")):
        assert "results/report.html cannot be written: Is a directory." in refusal(capsys, *command)
    assert len(results_in(finished)["cells"]) == 2


@pytest.mark.clause("REP-2")
@pytest.mark.parametrize("name", ["\x1b[31mred", "\x9b31mred", "\u202eder"])
def test_control_characters_in_names_of_files_are_shown_as_marks(
    name: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene_file(folder, name)
    for arguments in (
        ("scenes", "validate", f"{name}.json"),
        ("scenes", "validate", f"no {name}.json"),
        ("scenes", "show", f"{name}.json"),
        ("scenes", "export", f"{name}.json", "--to", "json", "--out", name),
        ("render", f"{name}.json", "-o", f"{name}/picture.tiff"),
        ("render", f"{name}.json", "-o", f"{name}.png"),
        ("truth", f"{name}.json", "--out", name),
        ("explain", f"{name}.json", "--pixel", "1,1"),
        ("run", f"{name}.json", "--renderer", "closed_form", "--out", f"{name} results"),
        ("run", f"{name}.json", "--renderer", name),
        ("report", f"no {name}"),
        (name,),
    ):
        _, out, err = run(capsys, *arguments)
        assert [character for character in out + err if not (character.isprintable() or character in "\n\t")] == []


def test_names_that_are_no_text_are_told_before_any_work(folder: Path) -> None:
    stray = os.fsdecode(b"stray-\xff")
    scene_file(folder, stray)
    done = run_apart(folder, "run", f"{stray}.json", "--renderer", "closed_form")
    assert (done.returncode, "expected a file name in UTF-8" in done.stderr) == (2, True)
    for arguments, told in (
        (("run", "small.json", "--out", stray), "--out: expected a folder whose name is UTF-8"),
        (("faults", "small.json", "--out", stray), "--out: expected a folder whose name is UTF-8"),
        (("truth", "small.json", "--out", stray), "--out: expected a folder whose name is UTF-8"),
        (("report", stray), "There is no results directory"),
    ):
        done = run_apart(folder, *arguments)
        assert (done.returncode, told in done.stderr, "Traceback" in done.stderr) == (2, True, False), done.stderr
    assert not (folder / stray).exists()


def test_a_lone_surrogate_in_a_file_of_waivers_is_one_sentence(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    waiver = {
        "renderer": "closed_form",
        "version": "*",
        "scene": "small",
        "integrator": "local",
        "most_failing_pixels": 1,
        "reason": "\ud800",
        "link": "https://example.org/half",
    }
    (folder / "waivers.json").write_text(json.dumps([waiver]), encoding="utf-8")
    assert "waivers.json" in refusal(capsys, "run", "small.json", "--waivers", "waivers.json")


@pytest.mark.clause("CMD-1")
@pytest.mark.parametrize("is_writable", [True, False])
def test_what_nobody_foresaw_ends_in_one_sentence_a_log_and_status_3(
    is_writable: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def mistaken() -> None:
        raise ZeroDivisionError("a mistake\nof ours")

    monkeypatch.setattr(command_line, "make_app", mistaken)
    (tmp_path / "file").touch()
    cache = tmp_path / ("cache" if is_writable else "file")
    monkeypatch.setenv("RAYTRUTH_CACHE", str(cache))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))
    status, out, err = run(capsys, "scenes", "list", os.fsdecode(b"\xff"))
    assert (status, out, err.count("\n"), "Traceback" in err) == (3, "", 1, False)
    assert "mistake in raytruth itself (ZeroDivisionError: a mistake of ours)" in err
    (log,) = (cache / "logs" if is_writable else tmp_path / "temporary").iterdir()
    assert str(log) in err
    text = log.read_text(encoding="utf-8")
    for part in ("raytruth 0", "Python 3", "raytruth scenes list", "Traceback", "ZeroDivisionError"):
        assert part in text


def test_where_no_log_can_be_written_that_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def mistaken() -> None:
        raise ZeroDivisionError

    (tmp_path / "file").touch()
    monkeypatch.setattr(command_line, "make_app", mistaken)
    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path / "file"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "file"))
    status, _, err = run(capsys, "scenes", "list")
    assert (status, "no log of it could be written" in err) == (3, True)
