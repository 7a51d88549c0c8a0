"""Kept code depends on all that its functions name, however far away, and on nothing else."""

from __future__ import annotations

import inspect
import math
from typing import Any

import pytest

from raytruth.reference_tracer.compiler import types
from raytruth.reference_tracer.compiler.dependencies import said

pytestmark = pytest.mark.clause("ARI-12", "ARI-6")

FACTOR, UNNAMED = 2.0, 3.0


def outer(value: float) -> float:
    return middle(value) + 1.0


def middle(value: float) -> float:
    return inner(value) * 2.0


def inner(value: float) -> float:
    return FACTOR * math.sqrt(value) if value > 0.0 else outer(value)


def by_module(kind: Any) -> str:
    return types.shown(kind)


def lines(**names: Any) -> list[str]:
    return list(said(names))


def test_functions_that_functions_call_are_told_each_once_though_they_call_one_another() -> None:
    told = lines(outer=outer)
    assert [line.partition(":")[0] for line in told if "def " in line] == ["outer", "middle", "inner"]
    assert "FACTOR = 2.0" in told
    assert "math.sqrt = <built-in function sqrt>" in told
    assert not any("UNNAMED" in line for line in told)


def test_a_changed_constant_far_away_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    before = lines(outer=outer)
    monkeypatch.setitem(globals(), "FACTOR", 2.5)
    assert lines(outer=outer) != before


def test_functions_of_modules_that_are_named_are_told() -> None:
    assert f"{types.__name__}.shown: {inspect.getsource(types.shown)}" in lines(by_module=by_module)


def test_names_that_are_no_functions_are_their_values() -> None:
    assert lines(a=1.5, b=-0.0) == ["b = -0.0", "a = 1.5"]
