"""The sample repository does what it shows: every command of its workflow runs here, and a spoilt tracer is found."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml

import pytest

from raytruth.comparisons.matrix.quick_suite import quick_scenes
from tests.plain_yaml import read_yaml
from tests.raytruth.plugin_runs import environment_with_plugin, run_pytest

pytestmark = pytest.mark.clause("CMD-5", "PRJ-2")

SAMPLE = Path(__file__).parent.parent / "examples" / "sample-repository"
WORKFLOW = read_yaml((SAMPLE / ".github" / "workflows" / "raytruth.yml").read_text(encoding="utf-8"))
STEPS: list[dict[str, Any]] = WORKFLOW["jobs"]["judge"]["steps"]
README = (SAMPLE / "README.md").read_text(encoding="utf-8")
OWN_TESTS = 4


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Of a job: Python is found on the path, raytruth is installed, and pip fetches and changes nothing."""
    variables = environment_with_plugin(tmp_path_factory.mktemp("installed"))
    own_path = os.pathsep.join([str(Path(sys.executable).parent), variables["PATH"]])
    pip = {"PIP_NO_INDEX": "1", "PIP_DRY_RUN": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    return {**variables, **WORKFLOW["env"], **pip, "PATH": own_path, "GITHUB_STEP_SUMMARY": "summary.md"}


@pytest.fixture(scope="module")
def after_the_workflow(tmp_path_factory: pytest.TempPathFactory, environment: dict[str, str]) -> Path:
    """A copy of the repository in which all commands of the workflow have run, as GitHub runs them."""
    folder = tmp_path_factory.mktemp("sample") / "repository"
    shutil.copytree(SAMPLE, folder, ignore=shutil.ignore_patterns("__pycache__", "results"))
    for command in [step["run"] for step in STEPS if "run" in step]:
        shell = ["bash", "--noprofile", "--norc", "-e", "-o", "pipefail", "-c", command]
        finished = subprocess.run(shell, cwd=folder, env=environment, capture_output=True, text=True, check=False)
        assert finished.returncode == 0, finished.stdout + finished.stderr
    return folder


def test_the_workflow_is_one_that_github_takes() -> None:
    assert set(WORKFLOW) == {"name", "on", "env", "jobs"}
    assert {"push", "pull_request"} == set(WORKFLOW["on"])
    for step in STEPS:
        assert ("uses" in step) != ("run" in step)
        assert re.fullmatch(r"actions/[a-z-]+@v\d+", step.get("uses", "actions/x@v1"))
        assert set(step) <= {"name", "uses", "run", "with", "if"}
    (cache,) = (step["with"]["path"] for step in STEPS if "cache" in step.get("uses", ""))
    assert cache == "~/.cache/raytruth"


def test_each_scene_of_the_quick_suite_is_a_test_beside_the_tracers_own(after_the_workflow: Path) -> None:
    cases = list(Xml.parse(after_the_workflow / "tests.xml").getroot().iter("testcase"))
    judged = [case for case in cases if str(case.get("classname")) == "raytruth.sample-tracer.whitted"]
    assert {case.get("name") for case in judged} == set(quick_scenes())
    assert len(cases) == len(judged) + OWN_TESTS
    assert sum(case.find("skipped") is None for case in judged) >= 5
    assert [case for case in cases if case.find("failure") is not None or case.find("error") is not None] == []


@pytest.mark.clause("REP-9")
def test_what_the_workflow_keeps_is_there_after_it(after_the_workflow: Path) -> None:
    (kept,) = (step["with"]["path"] for step in STEPS if "upload-artifact" in step.get("uses", ""))
    assert all((after_the_workflow / path).exists() for path in kept.split())
    assert (after_the_workflow / "results" / "report.html").is_file()
    summary = (after_the_workflow / "summary.md").read_text(encoding="utf-8")
    assert re.match(r"## raytruth: All \d comparable cells passed\n", summary)
    suites = Xml.parse(after_the_workflow / "junit.xml").getroot()
    assert (suites.get("tests"), suites.get("failures")) == (str(len(quick_scenes())), "0")


def test_a_spoilt_tracer_fails_with_the_worst_pixel(after_the_workflow: Path, environment: dict[str, str]) -> None:
    folder = after_the_workflow.with_name("spoilt")
    shutil.copytree(SAMPLE, folder)
    tracer = folder / "tracer.py"
    right = tracer.read_text(encoding="utf-8")
    spoilt = right.replace("-2 * dot(direction, normal)", "-2.001 * dot(direction, normal)")
    assert spoilt != right
    tracer.write_text(spoilt, encoding="utf-8")
    finished = run_pytest(folder, environment, "-k", "concave-mirror")
    assert "1 failed" in finished.stdout
    assert re.search(r"fail: \d+ of 224 pixels lie outside their feasible sets\nWorst pixel \(", finished.stdout)


def test_the_readme_names_each_file_and_commands_that_work(
    after_the_workflow: Path, environment: dict[str, str]
) -> None:
    files = {path.relative_to(SAMPLE).as_posix() for path in SAMPLE.rglob("*.*") if path.is_file()}
    kept = {name for name in files if not name.endswith(".pyc")}
    assert set(re.findall(r"^\| `(.+?)` \|", README, re.MULTILINE)) == kept - {"README.md"}
    (badge,) = re.findall(r"actions/workflows/([\w.]+)/badge\.svg", README)
    assert (SAMPLE / ".github" / "workflows" / badge).is_file()
    chosen = {}
    for option, value in re.findall(r"^pytest (-[km]) (\S+)", README, re.MULTILINE):
        told = run_pytest(after_the_workflow, environment, "--collect-only", "-q", option, value).stdout
        chosen[value] = len([line for line in told.splitlines() if "::" in line])
    assert chosen == {"raytruth": len(quick_scenes()), "concave-mirror": 1}
