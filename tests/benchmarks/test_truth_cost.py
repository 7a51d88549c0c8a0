from __future__ import annotations

import json
import math

import pytest

from benchmarks import truth_cost

pytestmark = pytest.mark.clause("BEN-1")


def test_the_document_has_each_scene_beside_the_other_arithmetics(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(truth_cost, "SCENES", ("ambient-sphere",))
    monkeypatch.setattr(truth_cost, "STRIDE", 32)
    truth_cost.main(["--json", "--rounds", "3"])
    told = json.loads(capsys.readouterr().out)
    assert list(told)[:2] == ["machine", "ratios"]
    assert [ratio["name"] for ratio in told["ratios"]] == [
        "ambient-sphere, Arb's balls",
        "ambient-sphere, interpreted float",
        "ambient-sphere, compiled float64",
    ]
    for ratio in told["ratios"]:
        assert all(math.isfinite(ratio[key]) and ratio[key] > 0 for key in ("truth_seconds", "other_seconds"))
        assert 0 < ratio["low"] <= ratio["ratio"] <= ratio["high"]
