from __future__ import annotations

import json
import re
import shlex
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree as Xml

import pytest

from raytruth.cells_as_tests import CellPlugin
from raytruth.comparisons.matrix.results_directory import only_run_in
from tests.comparisons.matrix.scene_files import scene_file
from tests.raytruth.plugin_runs import environment_with_plugin, run_pytest

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("CMD-5")

# Each scene is judged as it is called; what is otherwise judged is tested elsewhere.
CONFTEST = """
from pathlib import Path

from raytruth.comparisons.records.results import Cell, Waived, WorstPixel, Judgement
from raytruth.judged_programs import JudgedPrograms

WORST = WorstPixel(x=3, y=2, value=(1, 1, 1), truth=(0, 0, 0), low=(0, 0, 0), high=(0.5, 0.5, 0.5), tolerances=4)
JUDGEMENT = Judgement(pixels=12, failing=1, unjudged=0, capped=0, ambiguous=0, worst=WORST)


def judged(self, place):
    scene, renderer, integrator = place
    if scene == "mistake":
        raise AssertionError("this cannot be")
    if scene == "full-disk":
        raise OSError(28, "No space left on device", "results/x")
    verdict = "fail" if scene == "waived" else "pass" if scene == "unmatched" else scene
    cell = Cell(scene=scene, renderer=renderer, integrator=integrator, verdict=verdict,
                reason=f"the reason of {scene} \\x1b[31m", judgement=JUDGEMENT, command=f"raytruth run {scene}.json")
    if scene == "waived":
        cell = cell.model_copy(update={"waived": Waived(reason="It is known.", link="https://example.org/known")})
    return cell, ["The waiver matches nothing."] if scene == "unmatched" else []


JudgedPrograms.judged = judged
JudgedPrograms.write_report = lambda self, places: Path(f"report-of-{len(places)}.html")
"""
ENDINGS = {
    "pass": "passed",
    "declared": "passed",
    "fail": "failed",
    "error": "failed",
    "waived": "xfailed",
    "incomparable": "skipped",
    "unavailable": "skipped",
    "unmatched": "failed",
    "mistake": "failed",
    "full-disk": "failed",
}
COMMAND = f"mine={shlex.quote(sys.executable)} -c pass {{scene}} {{output}}"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """The working directory: a scene for each verdict."""
    for name in ENDINGS:
        scene_file(tmp_path, name)
    (tmp_path / "conftest.py").write_text(CONFTEST, encoding="utf-8")
    return tmp_path


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return environment_with_plugin(tmp_path_factory.mktemp("installed"))


def options(*names: str) -> list[str]:
    return ["--raytruth-command", COMMAND, *(f"--raytruth-scene={name}.json" for name in names)]


def summary(output: str) -> dict[str, tuple[str, str]]:
    """What pytest's short summary tells of each scene: how it ended, and why."""
    lines = re.findall(r"^(\w+)(?: \[1\])? raytruth::mine::whitted::([\w-]+)(?:: | - )?(.*)$", output, re.MULTILINE)
    return {scene: (word, why) for word, scene, why in lines}


WORDS = {"passed": "PASSED", "failed": "FAILED", "xfailed": "XFAIL", "skipped": "SKIPPED"}


@pytest.mark.parametrize("more", [[], ["-n", "2"]], ids=["alone", "xdist"])
def test_each_cell_is_a_test_that_ends_as_its_verdict_says(
    more: list[str], folder: Path, environment: dict[str, str]
) -> None:
    xml = ["--junit-xml", "tests.xml", "-rA", "-W", "error"]
    finished = run_pytest(folder, {**environment, "CI": "1"}, *options(*ENDINGS), *xml, *more)
    found = summary(finished.stdout)
    assert {scene: word for scene, (word, _) in found.items()} == {
        scene: WORDS[ending] for scene, ending in ENDINGS.items()
    }
    for scene in ("incomparable", "unavailable", "waived", "fail", "error"):
        assert f"the reason of {scene}" in found[scene][1]
    assert "waived: It is known. https://example.org/known" in found["waived"][1]
    assert "The waiver matches nothing." in found["unmatched"][1]
    assert finished.returncode == pytest.ExitCode.TESTS_FAILED
    assert "raytruth::mine::whitted::declared is as declared, not as due: the reason of declared" in finished.stdout
    assert "warning" not in finished.stdout
    assert f"Report: report-of-{len(ENDINGS)}.html" in finished.stdout
    cases = Xml.parse(folder / "tests.xml").getroot().iter("testcase")
    assert {case.get("name") for case in cases} == ENDINGS.keys()


@pytest.fixture(scope="module")
def failures(tmp_path_factory: pytest.TempPathFactory, environment: dict[str, str]) -> str:
    """What is printed of tests that fail."""
    folder = tmp_path_factory.mktemp("failures")
    (folder / "conftest.py").write_text(CONFTEST, encoding="utf-8")
    names = ("fail", "error", "mistake", "full-disk")
    for name in names:
        scene_file(folder, name)
    finished = run_pytest(folder, {**environment, "RAYTRUTH_CACHE": str(folder / "cache")}, *options(*names))
    assert "4 failed" in finished.stdout
    return finished.stdout


def test_a_failure_tells_reason_worst_pixel_and_how_to_repeat_it(failures: str) -> None:
    assert "fail: the reason of fail" in failures
    assert "Worst pixel (3, 2): it is (1, 1, 1), the truth is (0, 0, 0)" in failures
    assert "Repeat it: raytruth run fail.json" in failures


def test_no_failure_shows_code_of_ours_or_a_control_character(failures: str) -> None:
    assert "Traceback" not in failures
    assert "cells_as_tests.py" not in failures
    assert "\x1b[31m" not in failures


@pytest.mark.clause("CMD-1")
def test_a_mistake_of_our_own_is_a_sentence_that_names_a_log(failures: str) -> None:
    found = re.search(r"a mistake in raytruth itself \(AssertionError: this cannot be\); .* log (\S+)\.", failures)
    assert found is not None
    assert "No space left on device" in failures


@pytest.mark.clause("VER-14")
def test_what_is_as_declared_fails_where_strict(folder: Path, environment: dict[str, str]) -> None:
    strict = run_pytest(folder, environment, *options("declared", "pass"), "--raytruth-strict")
    assert "declared: the reason of declared" in strict.stdout
    assert "1 failed, 1 passed" in strict.stdout


def test_tests_are_chosen_as_all_others_are(folder: Path, environment: dict[str, str]) -> None:
    (folder / "test_own.py").write_text("def test_own(): pass", encoding="utf-8")
    chosen = {
        ("-m=raytruth", "-k=fail or own or error", "--deselect=raytruth::mine::whitted::error"): ["fail"],
        ("-m=not raytruth",): ["test_own"],
    }
    for more, names in chosen.items():
        finished = run_pytest(folder, environment, *options(*ENDINGS), "--collect-only", "-q", *more)
        assert [line.rpartition("::")[2] for line in finished.stdout.splitlines() if "::" in line] == names


def config(**given: Any) -> Any:
    """Of a run of pytest with these of our options."""
    by_default = {"command": [], "file": [], "scene": [], "quick": False, "strict": False, "waivers": None}
    values = {f"raytruth_{name}": value for name, value in {**by_default, "out": "results", **given}.items()}
    return SimpleNamespace(getoption=lambda name: values.get(name, False))


def started(**given: Any) -> CellPlugin:
    """The plugin in a run of pytest with these options, which has begun."""
    session: Any = SimpleNamespace(config=config(**given))
    plugin = CellPlugin(session.config)
    plugin.pytest_sessionstart(session)
    return plugin


@pytest.mark.clause("CMD-2")
@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"command": ["./nothing {scene} {output}"]}, "expected a program, found none at"),
        ({"command": [f"Bad-{COMMAND}"]}, "lower-case letters"),
        ({"command": [COMMAND, COMMAND]}, "--raytruth-command 'mine="),
        ({"file": ["nothing.toml"]}, "nothing.toml: expected a TOML file"),
        ({"command": [COMMAND], "scene": ["whited-1980"]}, "whitted-1980"),
        ({"command": [COMMAND], "scene": ["fail.json", "fail.json"]}, "There are two scenes called 'fail'"),
        ({"command": [COMMAND], "scene": ["fail.json"], "quick": True}, "--raytruth-quick: expected no"),
        ({"command": [COMMAND], "out": "fail.json"}, "expected a folder, but fail.json is a file"),
        ({"command": [COMMAND], "waivers": "fail.json"}, "fail.json: "),
    ],
)
def test_bad_usage_is_a_sentence(
    given: dict[str, Any], sentence: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    with pytest.raises(pytest.UsageError, match=re.escape(sentence)) as caught:
        started(**given)
    assert "--renderer-" not in str(caught.value)
    assert not (folder / "results").exists()


@pytest.mark.clause("VER-13")
def test_a_file_of_waivers_may_be_about_the_program(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    waiver = {"renderer": "mine", "version": "*", "scene": "fail", "integrator": "whitted", "most_failing_pixels": 3}
    reasons = {"reason": "It is known.", "link": "https://example.org/known"}
    (folder / "waivers.json").write_text(json.dumps([waiver | reasons]), encoding="utf-8")
    given = {"command": [COMMAND], "scene": ["fail.json"], "waivers": "waivers.json"}
    assert started(**given).judged.waivers[0].reason == "It is known."


@pytest.mark.clause("RES-5")
def test_two_runs_do_not_write_into_one_directory(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    given = {"command": [COMMAND], "scene": ["pass.json"]}
    with only_run_in(folder / "results"), pytest.raises(pytest.UsageError, match="another run is writing there"):
        started(**given)
    plugin = started(**given)
    with pytest.raises(OSError, match="another run"), only_run_in(folder / "results"):
        pass
    plugin.pytest_sessionfinish()
    with only_run_in(folder / "results"):
        pass


def test_help_and_a_list_of_tests_judge_nothing(folder: Path, environment: dict[str, str]) -> None:
    for option in ("--help", "--collect-only"):
        assert run_pytest(folder, environment, *options("pass"), option).returncode == 0
    assert not (folder / "results").exists()
