"""Each attack on each rung that this machine has, and in no sandbox, where it must succeed, or it proves nothing."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.attacks import ladder
from raytruth.comparisons.attacks.attacks import ATTACKS, attacked
from raytruth.comparisons.attacks.grader import Grader, attacked_grader
from raytruth.comparisons.attacks.ladder import tried
from raytruth.comparisons.sandboxes.sandbox import RUNGS, is_root
from tests.comparisons.attacks.rungs import why_not

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.sandboxes.sandbox import Rung

pytestmark = pytest.mark.clause("SBX-1")

# What another user id does not hold: it has the rights of everybody on this machine.
BEYOND_A_USER_ID = {"shared_folders", "network", "truth", "rubric", "others"}
# What limits on a process hold without any sandbox.
HELD_ANYHOW = {"memory_of_one", "one_file", "processor", "output", "escape", "links"}


@pytest.fixture
def grader() -> Iterator[Grader]:
    with attacked_grader() as it:
        yield it


@pytest.mark.parametrize("rung", RUNGS)
@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_is_held_or_plainly_reported_as_not_enforced(name: str, rung: Rung, grader: Grader) -> None:
    if why_not(rung):
        return  # which is told, as is tested below
    result = attacked(name, rung, grader)
    if name == "home" and "home" not in grader.files:
        assert result.result == "not tried"
    elif rung == "user" and name in BEYOND_A_USER_ID and result.result != "held":
        assert result.result == "not enforced"
        assert result.detail
    else:
        assert result.result == "held", result.detail


@pytest.mark.parametrize("rung", RUNGS)
def test_a_rung_works_or_it_is_said_in_words_what_is_in_its_way(rung: Rung, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ladder, "ATTACKS", {"becoming_root": ATTACKS["becoming_root"]})  # all are tried above
    result = tried(rung)
    assert result.works == (not why_not(rung))
    assert bool(result.attacks) == result.works
    # Where all that tests need is installed, that is so.
    assert "not installed" not in result.reason or not os.environ.get("RAYTRUTH_REQUIRE_ALL")
    # Of the three only bubblewrap needs what containers may forbid, and then it says what.
    reasons = ("not installed", "kernel", "only root", *(["bwrap: "] if rung == "bubblewrap" else []))
    assert result.works or any(reason in result.reason for reason in reasons), result.reason


@pytest.mark.parametrize("name", ATTACKS)
def test_what_only_a_sandbox_holds_succeeds_without_one(name: str, grader: Grader) -> None:
    result = attacked(name, None, grader)
    if name in HELD_ANYHOW or (name == "becoming_root" and not is_root()):
        assert result.result == "held", result.detail
    else:
        assert result.result == "not enforced"
        assert result.detail
