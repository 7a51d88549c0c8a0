from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.attacks import ladder
from raytruth.comparisons.attacks.ladder import chosen, result_of, tried
from raytruth.comparisons.records.sandbox_results import AttackResult, RungResult
from raytruth.comparisons.sandboxes.sandbox import SandboxError
from raytruth.reports.sandbox_text import attack_words, sandbox_sentence

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.sandboxes.sandbox import Rung

pytestmark = pytest.mark.clause("SBX-5")


def only(monkeypatch: pytest.MonkeyPatch, *working: Rung, root: bool) -> None:
    """Have these rungs work here, and no others."""
    monkeypatch.setattr(
        ladder,
        "result_of",
        lambda rung: RungResult(rung=rung, works=rung in working, reason="" if rung in working else "it is broken"),
    )
    monkeypatch.setattr(ladder, "is_root", lambda: root)


def test_the_first_rung_that_works_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "bubblewrap", "landlock", "user", root=True)
    assert chosen("auto").rung == "bubblewrap"
    only(monkeypatch, "landlock", "user", root=True)
    assert chosen("auto").rung == "landlock"
    only(monkeypatch, "user", root=True)
    assert chosen("auto").rung == "user"
    assert chosen("user").rung == "user"


def test_a_rung_that_is_asked_for_and_does_not_work_is_refused_with_the_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, "user", root=True)
    with pytest.raises(SandboxError, match=r"no sandbox works here.*\(bubblewrap: it is broken\)"):
        chosen("bubblewrap")


@pytest.mark.clause("SBX-2")
def test_root_runs_nothing_without_a_sandbox(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, root=True)
    with pytest.raises(SandboxError, match="never runs as root"):
        chosen("none")
    with pytest.raises(SandboxError, match="bubblewrap: it is broken; landlock: it is broken; user: it is broken"):
        chosen("auto")


def test_an_ordinary_user_without_any_sandbox_is_told_so(monkeypatch: pytest.MonkeyPatch) -> None:
    only(monkeypatch, root=False)
    for result in (chosen("auto"), chosen("none")):
        assert result.rung == "none"
        assert sandbox_sentence(result).startswith("The program runs in no sandbox: it runs with all rights")
    assert "bubblewrap: it is broken" in sandbox_sentence(chosen("auto"))


@pytest.mark.clause("SBX-1")
def test_what_was_tried_is_kept_until_the_machine_changes(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    calls: list[Rung] = []

    def counted(rung: Rung) -> RungResult:
        calls.append(rung)
        return RungResult(rung=rung, works=True)

    monkeypatch.setenv("RAYTRUTH_CACHE", str(tmp_path))
    monkeypatch.setattr(ladder, "tried", counted)
    monkeypatch.setattr(ladder, "missing_for", lambda _: None)
    assert result_of("user") == result_of("user")
    assert calls == ["user"]
    monkeypatch.setattr(ladder, "_machine", lambda: "another")
    result_of("user")
    assert calls == ["user", "user"]
    (kept,) = (tmp_path / "sandboxes").glob("user-another.json")
    kept.write_text("garbage")
    result_of("user")
    assert calls == ["user", "user", "user"]


def test_a_rung_whose_program_is_missing_says_how_to_install_it(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    result = tried("bubblewrap")
    assert not result.works
    assert "apt-get install bubblewrap" in result.reason


def test_the_sentence_names_what_is_not_enforced() -> None:
    attacks = (
        AttackResult(attack="the network", result="not enforced", detail="reached it"),
        AttackResult(attack="a fork bomb", result="held", detail=""),
    )
    sentence = sandbox_sentence(RungResult(rung="user", works=True, attacks=attacks))
    assert sentence.endswith("the sandbox user, which held 1 of 2 attacks tried here; not enforced: the network.")
    assert [attack_words(it) for it in attacks] == ["not enforced: reached it", "held"]
