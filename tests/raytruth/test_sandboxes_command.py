from __future__ import annotations

import pytest

from raytruth import sandboxes_command
from raytruth.comparisons.records.sandbox_results import AttackResult, RungResult
from raytruth.comparisons.sandboxes.sandbox import Rung  # noqa: TC001 - beside what is used at run time
from tests.raytruth.running import document, run

pytestmark = pytest.mark.clause("SBX-1", "CMD-3")


def tried(rung: Rung) -> RungResult:
    """One rung that works, and two that do not; what trying them for real gives, tests/comparisons/attacks/ holds."""
    if rung != "user":
        return RungResult(rung=rung, works=False, reason="it is not installed")
    reached = AttackResult(attack="the network", result="not enforced", detail="reached a server")
    return RungResult(rung=rung, works=True, attacks=(reached,))


def test_each_rung_is_told_with_what_held_or_why_it_cannot_be_used(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sandboxes_command, "tried", tried)
    status, out, _ = run(capsys, "sandboxes")
    assert status == 0
    assert out.splitlines() == [
        "bubblewrap: cannot be used: it is not installed",
        "landlock: cannot be used: it is not installed",
        "user: works",
        "  the network: not enforced: reached a server",
    ]
    told = document(capsys, "sandboxes")["sandboxes"]
    assert [it["works"] for it in told] == [False, False, True]
    assert told[2]["attacks"][0]["result"] == "not enforced"


def test_where_no_rung_works_the_exit_status_says_so(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sandboxes_command, "tried", lambda rung: RungResult(rung=rung, works=False, reason="no"))
    assert run(capsys, "sandboxes")[0] == 1
