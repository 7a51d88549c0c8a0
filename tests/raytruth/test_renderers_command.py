from __future__ import annotations

import re
import tomllib

import pytest

from raytruth.comparisons.renderers.closed_form.adapter import ClosedFormRenderer
from raytruth.comparisons.renderers.mitsuba.adapter import MitsubaRenderer
from raytruth.scenes.library import library_names
from tests.raytruth.running import document, refusal, run

pytestmark = pytest.mark.clause("CMD-3", "CMD-4", "REN-5")


def test_each_renderer_asked_for_has_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    status, out, err = run(capsys, "renderers", "raytruth", "closed_form")
    assert status == 0
    assert [line.split("\t")[0] for line in out.splitlines()] == ["raytruth", "closed_form"]
    assert err.splitlines() == ["Trying raytruth …", "Trying closed_form …"]


def test_json_tells_version_abilities_and_how_to_install(capsys: pytest.CaptureFixture[str]) -> None:
    (told,) = document(capsys, "renderers", "raytruth")["renderers"]
    assert told["name"] == "raytruth"
    assert told["available"] is True
    assert told["integrators"] == {"whitted": "ES{0,n}(DL|e)"}
    assert told["derived_for"] == "any version"
    assert told["install"]


@pytest.mark.clause("REN-7")
def test_a_version_that_the_error_model_was_not_derived_from_is_told_and_not_available(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(MitsubaRenderer, "version", lambda _self: "mitsuba 4.0.0")
    (told,) = document(capsys, "renderers", "mitsuba")["renderers"]
    assert (told["version"], told["derived_for"], told["available"]) == ("mitsuba 4.0.0", "mitsuba 3.9.1", False)
    assert run(capsys, "renderers", "mitsuba")[1].split("\t")[1:3] == ["mitsuba 4.0.0", "mitsuba 3.9.1"]


def test_the_error_model_is_told_field_by_field_in_words(capsys: pytest.CaptureFixture[str]) -> None:
    told = {record["name"]: record["error_model"] for record in document(capsys, "renderers")["renderers"]}
    model = told["mitsuba"]
    assert list(model) == list(told["raytruth"])
    assert model["arithmetic"] == "one operation errs by at most 2^-24 of its result"
    assert model["rays that leave a surface start"].startswith("8.94e-05·(1 + max|p|) along the normal")
    assert model["shadow rays end"] == "0.000894 of the distance before the light"
    assert model["output"] == "float32, linear, rounded to the nearest, not clipped"
    assert model["random numbers"] != "none"
    assert told["raytruth"]["random numbers"] == "none"
    line = run(capsys, "renderers", "raytruth")[1]
    assert "; output: float32, linear, rounded to the nearest, not clipped" in line


def test_what_a_renderer_can_express_follows_from_what_it_does_not_refuse(capsys: pytest.CaptureFixture[str]) -> None:
    told = {record["name"]: record for record in document(capsys, "renderers", "raytruth", "mitsuba")["renderers"]}
    assert told["raytruth"]["scenes"] == len(library_names())
    assert {"mirrors", "phong", "absorption", "spheres"} <= set(told["raytruth"]["features"])
    assert {"mirrors", "dielectrics", "diffuse", "checkerboard"} <= set(told["mitsuba"]["features"])
    assert {"phong", "absorption", "ambient"}.isdisjoint(told["mitsuba"]["features"])
    assert f"{len(library_names())} library scenes; absorption, ambient" in run(capsys, "renderers", "raytruth")[1]


@pytest.mark.parametrize("columns", [80, 120])
def test_on_a_terminal_each_renderer_is_a_block_that_fits_its_width(
    columns: int, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("COLUMNS", str(columns))
    lines = [
        re.sub(r"\x1b\[[0-9;]*m", "", line).rstrip() for line in run(capsys, "renderers", "raytruth")[1].splitlines()
    ]
    assert lines[0] == "raytruth"
    assert max(map(len, lines)) <= columns
    assert any(line.startswith("  light paths: whitted ES{0,n}(DL|e)") for line in lines)
    assert "    output: float32, linear, rounded to the nearest, not clipped" in lines


def test_a_renderer_that_cannot_run_is_missing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ClosedFormRenderer, "version", lambda _self: None)
    (told,) = document(capsys, "renderers", "closed_form")["renderers"]
    assert (told["version"], told["available"]) == (None, False)
    assert run(capsys, "renderers", "closed_form")[1].split("\t")[1] == "missing"


def test_an_unknown_renderer_is_one_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    assert "did you mean 'mitsuba'" in refusal(capsys, "renderers", "mitsbua")


def test_the_formulas_that_can_be_declared_are_listed_with_a_line_of_code(capsys: pytest.CaptureFixture[str]) -> None:
    told = document(capsys, "renderers", "--formulas")["formulas"]
    normals = {"field": "sphere_points", "value": "along the ray", "code": "n = (p - C)/r"}
    assert {**normals, "in_file": {"sphere_normals": "divided"}} in told
    lines = run(capsys, "renderers", "--formulas")[1].splitlines()
    assert len(lines) == len([formula for formula in told if formula["in_file"]])
    # Each line begins as it may stand in a file.
    stated = [tomllib.loads(line.partition("  ")[0]) for line in lines]
    assert stated == [formula["in_file"] for formula in told if formula["in_file"]]
    assert any(line.startswith('triangle = "moeller-trumbore"') and "p = cross(d, e2)" in line for line in lines)
