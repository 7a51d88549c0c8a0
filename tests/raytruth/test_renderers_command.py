from __future__ import annotations

from typing import TYPE_CHECKING

from comparisons.renderers.closed_form import ClosedFormRenderer
from tests.raytruth.running import document, refusal, run

if TYPE_CHECKING:
    import pytest


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
    assert told["install"]


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


def test_a_renderer_that_cannot_run_is_missing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ClosedFormRenderer, "version", lambda _self: None)
    (told,) = document(capsys, "renderers", "closed_form")["renderers"]
    assert (told["version"], told["available"]) == (None, False)
    assert run(capsys, "renderers", "closed_form")[1].split("\t")[1] == "missing"


def test_an_unknown_renderer_is_one_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    assert "did you mean 'mitsuba'" in refusal(capsys, "renderers", "mitsbua")
