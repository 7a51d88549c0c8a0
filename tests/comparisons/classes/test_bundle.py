from __future__ import annotations

import base64
import json
import os
import shlex
import shutil
import subprocess
import sys
import zipfile
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.command_line import main
from tests.comparisons.classes.small_class import written_assignment, written_submission
from tests.plain_yaml import read_yaml
from tests.rooms import ROOT

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CLA-7")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    written_assignment(tmp_path)
    return tmp_path


def bundle(service: str) -> None:
    assert main(["grade", "--bundle", service, "one.toml", "--out", "bundle"]) == 0


def run_script(script: Path, working: Path, **environment: str) -> int:
    """As the service runs it, with this raytruth in place of the one that it would install."""
    command = working.parent / "this-raytruth"  # one word without spaces, wherever this Python lies
    command.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m raytruth "$@"\n')
    command.chmod(0o755)
    own = {"RAYTRUTH_COMMAND": str(command), **environment}
    return subprocess.run(["bash", str(script)], cwd=working, env={**os.environ, **own}, check=False).returncode


def as_gradescope_runs_it(folder: Path, **environment: str) -> Any:
    """The bundle's archive in source/, the submission beside it, the script a level above."""
    root = folder / "autograder"
    with zipfile.ZipFile(folder / "bundle" / "autograder.zip") as archive:
        archive.extractall(root / "source")
    shutil.copy(root / "source" / "run_autograder", root)
    assert os.access(folder / "bundle" / "run_autograder", os.X_OK)
    (root / "submission_metadata.json").write_text(json.dumps({"previous_submissions": [{}, {}]}))
    run_script(root / "run_autograder", root, AUTOGRADER=str(root), **environment)
    return json.loads((root / "results" / "results.json").read_text())


def test_gradescope_gets_points_for_a_submission(folder: Path) -> None:
    bundle("gradescope")
    written_submission(folder / "autograder" / "submission")
    results = as_gradescope_runs_it(folder)
    assert results["score"] == 100
    assert (
        json.loads((folder / "autograder" / "graded" / "students" / "submission" / "grade.json").read_text())["attempt"]
        == 3
    )


def test_gradescope_gets_a_result_without_a_score_where_raytruth_fails(folder: Path) -> None:
    bundle("gradescope")
    written_submission(folder / "autograder" / "submission")
    results = as_gradescope_runs_it(folder, RAYTRUTH_COMMAND="false")
    assert "score" not in results
    assert "no grade" in results["output"]


def test_gradescopes_set_up_makes_the_environment_that_its_script_runs(folder: Path) -> None:
    bundle("gradescope")
    root = folder / "autograder"
    shutil.copytree(folder / "bundle", root / "source")
    tools = folder / "tools"  # stand for what a container would fetch
    tools.mkdir()
    (tools / "apt-get").write_text("#!/bin/sh\nexit 0\n")
    (tools / "python3").write_text('#!/bin/sh\nmkdir -p "$3/bin"; cp "$(dirname "$0")/pip" "$3/bin/pip"\n')
    (tools / "pip").write_text('#!/bin/sh\necho "$@" > "$(dirname "$0")/raytruth"\n')
    for tool in tools.iterdir():
        tool.chmod(0o755)
    path = f"{tools}{os.pathsep}{os.environ['PATH']}"
    assert run_script(root / "source" / "setup.sh", root, AUTOGRADER=str(root), PATH=path) == 0
    assert (root / "venv" / "bin" / "raytruth").read_text() == "install --quiet raytruth\n"


@pytest.mark.parametrize(("misdeed", "score"), [("", 1.0), ("sys.exit('no picture')", 0.0)])
def test_prairielearn_gets_a_share_of_the_points(misdeed: str, score: float, folder: Path) -> None:
    bundle("prairielearn")
    root = folder / "grade"
    written_submission(folder / "own", misdeed)
    (root / "student").mkdir(parents=True)
    shutil.make_archive(str(root / "student" / "tracer"), "zip", folder / "own")  # as pl-file-upload asks for it
    shutil.copytree(folder / "bundle" / "tests", root / "tests")
    assert run_script(root / "tests" / "run.sh", root, GRADE=str(root)) == 0
    results = json.loads((root / "results" / "results.json").read_text())
    assert (results["gradable"], results["score"]) == (True, score)
    info = json.loads((folder / "bundle" / "info.json").read_text())
    assert (info["title"], info["externalGradingOptions"]["entrypoint"]) == ("One sphere", "/grade/tests/run.sh")


def test_prairielearn_is_told_that_nothing_can_be_graded_where_raytruth_fails(folder: Path) -> None:
    bundle("prairielearn")
    root = folder / "grade"
    written_submission(root / "student")
    shutil.copytree(folder / "bundle" / "tests", root / "tests")
    run_script(root / "tests" / "run.sh", root, GRADE=str(root), RAYTRUTH_COMMAND="false")
    assert json.loads((root / "results" / "results.json").read_text())["gradable"] is False


def test_github_classrooms_workflow_hands_the_points_to_its_reporter(folder: Path) -> None:
    bundle("github-classroom")
    repository = written_submission(folder / "repository")
    shutil.copytree(folder / "bundle" / ".github", repository / ".github")
    workflow = read_yaml((repository / ".github" / "workflows" / "classroom.yml").read_text())
    (step,) = [it for it in workflow["jobs"]["grade"]["steps"] if it.get("id") == "grade"]
    assert step["run"] == "bash .github/classroom/grade.sh"
    files = {"GITHUB_OUTPUT": str(folder / "output"), "GITHUB_STEP_SUMMARY": str(folder / "summary")}
    assert run_script(repository / ".github" / "classroom" / "grade.sh", repository, **files) == 0
    name, _, encoded = (folder / "output").read_text().partition("=")
    results = json.loads(base64.b64decode(encoded))
    assert (name, results["max_score"], results["tests"][0]["score"]) == ("result", 100, 100)
    assert "100 of 100 points" in (folder / "summary").read_text()
    assert (
        run_script(repository / ".github" / "classroom" / "grade.sh", repository, **files, RAYTRUTH_COMMAND="false")
        == 1
    )


def test_a_bundle_holds_the_assignments_own_scenes_and_overwrites_nothing(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "scenes").mkdir()
    shown = (ROOT / "scenes" / "library" / "single-sphere.json").read_text()
    (folder / "scenes" / "mine.json").write_text(shown)
    text = (folder / "one.toml").read_text().replace('"single-sphere"', '"scenes/mine.json"')
    (folder / "one.toml").write_text(text)
    bundle("prairielearn")
    assert (folder / "bundle" / "tests" / "scenes" / "mine.json").read_text() == shown
    assert main(["grade", "--bundle", "prairielearn", "one.toml", "--out", "bundle"]) == 2
    assert "is there already" in capsys.readouterr().err
