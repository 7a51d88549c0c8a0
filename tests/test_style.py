"""Rules of this project that no linter knows."""

from __future__ import annotations

import ast
import io
import re
import subprocess
import tokenize
from typing import TYPE_CHECKING

import pytest

from tests.rooms import FOLDERS, ROOT

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-1")

SOURCES = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]
TESTS = sorted((ROOT / "tests").rglob("*.py"))

# A file that needs more has a second topic.
MOST_LINES = 350

# A function of more does not fit on a screen. Not counted is its docstring: a command's is its help text.
MOST_LINES_OF_A_FUNCTION = 40
SLAB = "test_the_mean_over_a_glass_slab_is_the_known_one_and_batches_and_pixels_are_independent"
# By file and name, each with the reason why it is longer.
LONGER_FUNCTIONS = {
    ("tests/comparisons/renderers/mitsuba/test_adapter.py", SLAB): "one rendering of seconds, held against four laws",
    ("tests/scenes/scene_files.py", "valid_scene"): "one scene, written down as data",
    (
        "tests/second_opinion/flat_glass.py",
        "prism_at_the_critical_angle",
    ): "one derivation, whose angles all of it shares",
}

# Joined here, so that this file may be searched, too.
REGISTRY_HOSTS = ["py" + "pi.org", "python" + "hosted.org", "crates" + ".io", "npm" + "js.org", "deb." + "debian.org"]
MACHINE_PATH = re.compile(r"(?<![\w.}])/(work|root|home|Users)/\w")

# Folders of tests that look at more than one source folder.
TESTS_BY_PURPOSE = {"properties", "extremes", "second_opinion", "meta", "mutation", "browser"}


def tracked_text_files() -> list[Path]:
    """All files of the repository that are not pictures; in a tree without git, the Python files."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=False).stdout.decode()
    paths = [ROOT / name for name in listed.split("\0") if name] or [*SOURCES, *TESTS]
    return [path for path in paths if path.suffix not in {".png", ".exr"} and path.is_file() and not is_binary(path)]


def is_binary(path: Path) -> bool:
    """Whether it is one of the mesh files of bytes, whose headers are text."""
    return path.suffix == ".ply" and b"\nformat binary" in path.read_bytes()


def relative(path: Path) -> str:
    return str(path.relative_to(ROOT))


@pytest.mark.parametrize("path", [*SOURCES, *TESTS], ids=relative)
def test_a_file_is_short_enough_for_one_topic(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= MOST_LINES


def long_functions(path: Path) -> set[str]:
    """The functions and methods of a file that have more lines than they should, without their docstrings."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            docstring = lines_of(node.body[0]) if ast.get_docstring(node) else 0
            if lines_of(node) - docstring > MOST_LINES_OF_A_FUNCTION:
                found.add(node.name)
    return found


def lines_of(node: ast.stmt) -> int:
    assert node.end_lineno is not None
    return node.end_lineno - node.lineno + 1


def test_a_function_fits_on_a_screen_or_has_a_reason() -> None:
    longer = {(relative(path), name) for path in [*SOURCES, *TESTS] for name in long_functions(path)}
    assert longer == LONGER_FUNCTIONS.keys()


@pytest.mark.parametrize("path", SOURCES, ids=relative)
def test_what_is_public_says_what_it_is(path: Path) -> None:
    module = ast.parse(path.read_text(encoding="utf-8"))
    assert ast.get_docstring(module)
    waiting: list[ast.AST] = [module]
    while waiting:
        for node in ast.iter_child_nodes(waiting.pop()):
            if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_"):
                overrides_a_visitor = node.name.startswith("visit_")
                assert ast.get_docstring(node) or overrides_a_visitor, f"line {node.lineno}: {node.name}"
                if isinstance(node, ast.ClassDef):
                    waiting.append(node)


@pytest.mark.parametrize("path", [*SOURCES, *TESTS], ids=relative)
def test_an_exception_from_the_linter_has_a_reason_and_no_handler_catches_everything(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT and "noqa" in token.string:
            assert re.search(r"# noqa: [A-Z]+\d+(, [A-Z]+\d+)* - \w", token.string), token.line
    handlers = (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.ExceptHandler))
    caught = {ast.unparse(handler.type) if handler.type else "everything" for handler in handlers}
    last_handler = {"Exception"} if path == ROOT / "raytruth" / "command_line.py" else set()
    assert caught & {"everything", "Exception", "BaseException"} == last_handler


def test_every_rule_switched_off_for_the_project_has_a_reason() -> None:
    lines = (ROOT / "pyproject.toml").read_text(encoding="utf-8").splitlines()
    switched_off = [line for line in lines if re.match(r'\s*"[A-Z]+\d+",', line)]
    assert switched_off
    assert [line for line in switched_off if "#" not in line] == []


def test_no_file_names_a_package_registry_or_a_path_of_one_machine() -> None:
    paths = tracked_text_files()
    assert paths
    for path in paths:
        text = path.read_text(encoding="utf-8")
        assert [host for host in REGISTRY_HOSTS if host in text] == [], path
        assert MACHINE_PATH.search(text) is None, path


def test_the_folders_of_tests_are_those_of_the_source() -> None:
    folders = {path.parent.relative_to(ROOT / "tests").parts[0] for path in TESTS if path.parent != ROOT / "tests"}
    assert folders - TESTS_BY_PURPOSE == set(FOLDERS)


@pytest.mark.clause("PRJ-4")
def test_constraints_are_names_and_versions_and_nothing_else() -> None:
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    assert lines
    assert [line for line in lines if not re.fullmatch(r"[\w.-]+==[\w.]+", line)] == []
