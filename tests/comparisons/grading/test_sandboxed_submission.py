"""A submission in the sandbox that is chosen here: what it sees, and what it leaves."""

from __future__ import annotations

import json
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import gettempdir
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.attacks.grader import runnable_python
from raytruth.comparisons.grading import sandboxed_submission
from raytruth.comparisons.grading.grade import Occasion, grade_submission
from raytruth.comparisons.grading.sandboxed_submission import in_sandbox
from raytruth.comparisons.grading.submission import submitted
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
from raytruth.comparisons.renderers.program.declaration_file import checked_declaration
from raytruth.comparisons.sandboxes import sandboxed_run
from raytruth.comparisons.sandboxes.sandbox import RUNGS, Sandbox, SandboxError, is_root
from tests.comparisons.attacks.rungs import why_not
from tests.comparisons.grading.small_scenes import ASSIGNMENT, small_scene
from tests.comparisons.renderers.program.scripts import grey_scene

if TYPE_CHECKING:
    from raytruth.comparisons.sandboxes.sandbox import Rung

pytestmark = pytest.mark.clause("SBX-3")

SECRET = "the solution"
# Writes grey, and says what it can read of the words after it.
READER = """
import json, os, struct, sys
from beside import GREY
told = [sorted(os.environ)]
for path in json.loads(sys.argv[4]):
    try:
        told.append(open(path).read())
    except OSError:
        told.append("closed")
try:
    open(__file__, "a")
    told.append("wrote to itself")
except OSError:
    pass
print(*told)
with open(sys.argv[3], "wb") as file:
    file.write(b"PF %s %s -1.0\\n" % (sys.argv[1].encode(), sys.argv[2].encode()))
    file.write(struct.pack("<3f", *GREY) * (int(sys.argv[1]) * int(sys.argv[2])))
if os.environ.get("FAIL"):
    sys.exit("told")
"""


def reader(folder: Path, *paths: Path, fails: bool = False) -> ProgramRenderer:
    """A program of two files in a folder that is closed to others, which tries to read these."""
    own = folder / "anna & co"
    own.mkdir()
    (own / "tracer.py").write_text(READER)
    (own / "beside.py").write_text("GREY = (0.5, 0.25, 0.125)")
    own.chmod(0o700)
    words = json.dumps([str(path) for path in paths])
    command = [str(runnable_python()), "anna & co/tracer.py", "{width}", "{height}", "{output}", words, "{scene}"]
    declared = {"name": "mine", "command": command, "writes": "pfm", "environment": {"FAIL": "1"} if fails else {}}
    return ProgramRenderer(checked_declaration(declared, "mine.toml"), folder, "--renderer-file mine.toml")


@pytest.mark.parametrize("rung", RUNGS)
@pytest.mark.clause("SBX-2")
def test_a_submission_runs_and_sees_its_own_files_and_nothing_of_the_graders(
    rung: Rung, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if why_not(rung):
        return  # which is told, as tests/comparisons/attacks/test_attacks.py holds
    monkeypatch.setenv("GITHUB_TOKEN", SECRET)
    inside, outside = tmp_path / "anna & co" / "rubric.toml", tmp_path / "bob" / "tracer.py"
    program = reader(tmp_path, inside, outside, fails=True)
    outside.parent.mkdir()
    for path in (inside, outside):
        path.write_text(SECRET)
    with in_sandbox(program, rung, [inside]) as confined:
        problem = submitted(confined, grey_scene()).problem
    assert problem.endswith("told")
    assert SECRET not in problem
    assert "wrote to itself" not in problem
    assert "GITHUB_TOKEN" not in problem
    assert problem.count("closed") == 2  # also for another user, since pytest's folders are closed to others


@pytest.mark.parametrize("rung", RUNGS)
def test_the_picture_of_a_submission_in_a_sandbox_is_the_one_that_it_writes_without(rung: Rung, tmp_path: Path) -> None:
    if why_not(rung):
        return  # which is told, as tests/comparisons/attacks/test_attacks.py holds
    program = reader(tmp_path)
    with in_sandbox(program, rung, []) as confined:
        given = submitted(confined, grey_scene())
    assert given.problem == ""
    assert given.image is not None
    assert given.image[0, 0].tolist() == [0.5, 0.25, 0.125]


def test_another_folder_is_seen_where_that_is_asked_for(tmp_path: Path) -> None:
    shared = tmp_path / "textures" / "marble"
    shared.parent.mkdir()
    shared.write_text("white")
    program = reader(tmp_path, shared, fails=True)
    for rung in (rung for rung in RUNGS if not why_not(rung)):
        if is_root() and rung != "bubblewrap":
            with pytest.raises(SandboxError, match=r"may not read .*textures"):
                in_sandbox(program, rung, [], [shared.parent]).__enter__()
            continue
        with in_sandbox(program, rung, [], [shared.parent]) as confined:
            assert "white" in submitted(confined, grey_scene()).problem


@pytest.mark.clause("SBX-6")
def test_a_sandbox_that_fails_is_the_graders_error_and_no_problem_of_the_submission(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = reader(tmp_path)
    monkeypatch.setattr(sandboxed_run, "missing_for", lambda _: "it was removed meanwhile")
    with (
        in_sandbox(program, "bubblewrap", []) as confined,
        pytest.raises(SandboxError, match="there is no sandbox bubblewrap here: it was removed meanwhile"),
    ):
        submitted(confined, grey_scene())


@pytest.mark.clause("SBX-6", "GRD-5")
def test_a_grade_without_a_sandbox_is_no_grade(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = reader(tmp_path)
    monkeypatch.setattr(sandboxed_run, "missing_for", lambda _: "it was removed meanwhile")
    with in_sandbox(program, "bubblewrap", []) as confined, ThreadPoolExecutor(1) as pool:
        graded = grade_submission(confined, ASSIGNMENT, {"all": [small_scene()]}, Occasion(), pool)
    assert graded.status == "grader_error"
    assert "it was removed meanwhile" in graded.scenes[0].reason


@pytest.mark.clause("SBX-2")
def test_what_another_user_leaves_in_a_folder_of_everybody_is_removed(tmp_path: Path) -> None:
    if why_not("user"):
        return
    left = Path(gettempdir()) / tmp_path.name
    (tmp_path / "work").mkdir()
    command = ["sh", "-c", f"mkdir -p {left}/deep && touch {left}/deep/file && exit 3"]
    with pytest.raises(RendererError, match="exit status 3"):
        run_isolated(command, tmp_path / "work", seconds=20, memory_bytes=1 << 28, sandbox=Sandbox("user"))
    assert not left.exists()


@pytest.mark.clause("SBX-6")
def test_an_interpreter_that_only_root_may_run_is_refused_before_any_scene(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = reader(tmp_path)
    monkeypatch.setattr(sandboxed_submission, "is_root", lambda: True)
    monkeypatch.setattr(sandboxed_submission, "is_open_to_others", lambda _: False)
    with pytest.raises(SandboxError, match="other users may not read"), in_sandbox(program, "user", []):
        pass
    with in_sandbox(program, "bubblewrap", []) as confined:
        assert isinstance(confined.sandbox, Sandbox)


@pytest.mark.parametrize("rung", ["bubblewrap", "landlock"])
def test_what_is_hidden_among_the_systems_files_is_not_seen(rung: Rung, tmp_path: Path) -> None:
    """A file that is there on every system stands for an assignment that lies in /etc or /usr/src."""
    if why_not(rung):
        return
    rubric, beside = Path("/etc/passwd"), Path("/etc/group")
    for hidden, expected in (([], 0), ([rubric], 1)):
        folder = tmp_path / str(len(hidden))
        folder.mkdir()
        program = reader(folder, beside, rubric, fails=True)
        with in_sandbox(program, rung, hidden) as confined:
            assert submitted(confined, grey_scene()).problem.count("closed") == expected
