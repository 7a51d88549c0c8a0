from __future__ import annotations

from typing import Any

import pytest

from raytruth.reports.changes import TITLES, changes
from tests.reports.test_causes import results

pytestmark = pytest.mark.clause("REP-12")

SCENES: dict[str, list[str]] = {"s": []}


def cell(verdict: str, error: float | None = None, **more: Any) -> dict[str, Any]:
    return {"scene": "s", "verdict": verdict, "largest_error": error, **more}


WAIVED = {"waived": {"reason": "known", "link": "https://example.org"}}


@pytest.mark.parametrize(
    ("before", "now", "kind"),
    [
        (cell("pass"), cell("fail"), "worse"),
        (cell("declared"), cell("error"), "worse"),
        (cell("fail", **WAIVED), cell("fail"), "worse"),
        (cell("error"), cell("pass"), "better"),
        (cell("fail"), cell("fail", **WAIVED), "better"),
        (cell("pass"), cell("declared"), "other"),
        (cell("fail"), cell("unavailable"), "other"),
        (cell("pass", 1e-6), cell("pass", 2e-6), "larger"),
        (cell("pass", 1e-6), cell("pass", 0.0), "smaller"),
        (None, cell("pass"), "new"),
        (cell("pass"), None, "gone"),
    ],
)
def test_each_kind_of_change_is_told_as_such(
    before: dict[str, Any] | None, now: dict[str, Any] | None, kind: str
) -> None:
    old, new = (results([c] if c else [], SCENES) for c in (before, now))
    (found,) = changes(old, new).items()
    assert found[0] == TITLES[kind]
    assert [change.kind for change in found[1]] == [kind]


def test_what_did_not_change_is_not_told() -> None:
    same = results([cell("pass", 1e-6), cell("fail", renderer="other")], SCENES)
    assert changes(same, same) == {}
