from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

from raytruth.reference_tracer.explanation import explain
from raytruth.reference_tracer.explanation_record import Explanation
from raytruth.scenes.library import open_scene
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-2", "CMD-3", "CMD-4")


def test_the_text_ends_with_the_pixel(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "explain", "single-sphere", "--pixel", "48,48")
    assert (status, err) == (0, "")
    assert out.startswith("Pixel (48, 48) of single-sphere")
    assert out.splitlines()[-1].startswith("Sum of the 1 contribution: the pixel is (")


def test_hexadecimal_text_has_no_decimal_colours(capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(capsys, "explain", "single-sphere", "--pixel", "48,48", "--hex")
    assert "0x1." in out.splitlines()[-1]


def test_json_is_the_whole_explanation_exactly(capsys: pytest.CaptureFixture[str]) -> None:
    told = document(capsys, "explain", "glass-sphere", "--pixel", "32,32")
    assert list(told)[:3] == ["scene", "x", "y"]
    assert Explanation.model_validate(told) == explain(open_scene("glass-sphere"), 32, 32)


@pytest.mark.parametrize(
    ("pixel", "expected"),
    [
        ("96,0", "outside the image of single-sphere: expected 0,0 (top left) to 95,95"),
        ("-1,5", "outside the image"),
        ("1", "expected X,Y"),
        ("1,2,3", "expected X,Y"),
        ("1.5,2", "expected X,Y"),
        ("a,b", "expected X,Y"),
        ("٣,٣", "expected X,Y"),
        ("9" * 5000 + ",0", "expected X,Y"),
    ],
)
def test_a_bad_pixel_is_one_sentence(pixel: str, expected: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert expected in refusal(capsys, "explain", "single-sphere", "--pixel", pixel)


def test_an_unknown_scene_is_one_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    assert "did you mean" in refusal(capsys, "explain", "glass-spher", "--pixel", "0,0")


def test_a_broken_file_tells_all_its_problems(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "broken.json"
    path.write_text("{}")
    status, out, err = run(capsys, "explain", str(path), "--pixel", "0,0")
    assert (status, out) == (2, "")
    assert err.count("broken.json: ") >= 4


@pytest.mark.clause("REP-14", "CMD-1")
def test_a_proof_is_written_and_holds(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "proof.json"
    assert run(capsys, "explain", "glass-sphere", "--pixel", "32,32", "--proof", str(file))[0] == 0
    status, out, err = run(capsys, "explain", "glass-sphere", "--check", str(file))
    assert (status, out, err) == (0, "The proof of pixel (32, 32) of glass-sphere holds.\n", "")
    assert document(capsys, "explain", "glass-sphere", "--check", str(file)) == {"holds": True, "problems": []}


@pytest.mark.clause("REP-14", "CMD-1")
def test_a_proof_that_does_not_hold_says_where(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "proof.json"
    run(capsys, "explain", "single-sphere", "--pixel", "48,48", "--proof", str(file))
    claimed = json.loads(file.read_text(encoding="utf-8"))
    claimed["explanation"]["rays"][0]["hit"]["distance"] += 1e-9
    file.write_text(json.dumps(claimed), encoding="utf-8")
    status, out, _ = run(capsys, "explain", "single-sphere", "--check", str(file))
    assert status == 1
    assert "explanation.rays.0.hit.distance: the proof says" in out


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ([], "expected either --pixel X,Y, or --check FILE alone"),
        (["--pixel", "1,1", "--check", "x"], "expected either --pixel X,Y, or --check FILE alone"),
        (["--check", "nowhere.json"], "nowhere.json: No such file"),
    ],
)
def test_a_pixel_or_a_proof_is_asked_for(
    arguments: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in refusal(capsys, "explain", "single-sphere", *arguments)


@pytest.mark.parametrize("text", ["", "{}", "[]", "\udcff", '{"proof_version": 2}'])
def test_a_file_that_is_no_proof_is_refused(text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "proof.json"
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    assert "write it anew by raytruth explain --proof" in refusal(
        capsys, "explain", "single-sphere", "--check", str(file)
    )
