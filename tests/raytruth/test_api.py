"""What `import raytruth` offers: its names, what importing costs, and that docs/python.md tells the truth about it."""

from __future__ import annotations

import ast
import inspect
import os
import re
import subprocess
import sys
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import pytest

import raytruth

pytestmark = pytest.mark.clause("PRJ-2")

ROOT = Path(__file__).parent.parent.parent
PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
SECTIONS = {part.partition("\n")[0].strip("`# "): part for part in re.split(r"^##", PAGE, flags=re.MULTILINE)[1:]}
# What is said of a parameter or a field: its name, the next cell, and the rest.
ROW = re.compile(r"^\| (`.+?`) \| (.*?) \|", re.MULTILINE)

FUNCTIONS = [name for name in raytruth.__all__ if inspect.isfunction(getattr(raytruth, name))]
CLASSES = [name for name in raytruth.__all__ if inspect.isclass(getattr(raytruth, name))]
CLASSES_WITH_FIELDS = [name for name in CLASSES if name in SECTIONS]

TYPES = """
from typing import assert_type

import numpy as np
from numpy.typing import NDArray

assert_type(scene, raytruth.Scene)
assert_type(raytruth.load_scene("single-sphere"), raytruth.Scene)
assert_type(raytruth.library_names(), tuple[str, ...])
assert_type(raytruth.render(scene, "float32"), NDArray[np.float64] | NDArray[np.float32])
assert_type(raytruth.truth(scene), raytruth.CertifiedImage)
assert_type(raytruth.truth(scene).middle, NDArray[np.float64])
assert_type(raytruth.explain(scene, 1, 2), raytruth.Explanation)
assert_type(raytruth.feasible_set(scene, error_model), raytruth.FeasibleSet)
assert_type(raytruth.judge(raytruth.render(scene), scene, error_model), raytruth.ImageJudgement)
assert_type(judgement.verdict, raytruth.Verdict)
assert_type(judgement.distances, NDArray[np.float64])
assert_type(worst, raytruth.WorstPixel)
"""
WRONG_TYPES = {
    "raytruth.no_such_name": 'Module has no attribute "no_such_name"',
    'raytruth.render("single-sphere")': 'Argument 1 to "render" has incompatible type "str"',
    'raytruth.render(scene, "half")': 'Argument 2 to "render" has incompatible type',
    "judgement.failing.anything": '"int" has no attribute "anything"',
}


def run_python(*arguments: str, **environment: str) -> str:
    """What an interpreter of its own prints."""
    command = [sys.executable, *arguments]
    told = subprocess.run(
        command, cwd=ROOT, env=os.environ | environment, capture_output=True, text=True, check=False, timeout=300
    )
    return told.stdout + told.stderr


def example() -> str:
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    return str(code)


def told_fields(name: str) -> dict[str, str]:
    """The fields and methods that the page tells of a class, each with what the cell after it says."""
    rows = ROW.findall(SECTIONS[name])
    return {field: cell for names, cell in rows for field in re.findall(r"`(\w+)", names)}


def field_names(known: Any) -> set[str]:
    """Of a dataclass or of a record."""
    return {field.name for field in fields(known)} if is_dataclass(known) else set(known.model_fields)


@pytest.mark.parametrize("name", raytruth.__all__)
def test_every_public_name_is_defined_and_documented_under_that_name(name: str) -> None:
    found = getattr(raytruth, name)
    assert found.__name__ == name
    assert found.__doc__
    assert name in dir(raytruth)


def test_another_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match=r"^module 'raytruth' has no attribute 'loadscene'$"):
        raytruth.loadscene  # noqa: B018 - asking for it is what is tested


def test_importing_raytruth_imports_no_library_and_no_module_of_ours() -> None:
    code = "import sys; before = set(sys.modules); import raytruth; print(*(set(sys.modules) - before))"
    imported = set(run_python("-c", code).split())
    assert "raytruth" in imported
    assert {name for name in imported if name.partition(".")[0] not in sys.stdlib_module_names} == {"raytruth"}


def test_loading_a_scene_imports_nothing_that_only_rendering_and_judging_need() -> None:
    code = "import sys, raytruth; raytruth.load_scene('single-sphere'); print(*sys.modules)"
    imported = set(run_python("-c", code).split())
    assert "raytruth.scenes.loading" in imported
    assert imported.isdisjoint({"numpy", "llvmlite", "flint", "mitsuba", "OpenImageIO"})


def test_the_page_says_that_all_else_is_private() -> None:
    assert "**What this page names is public. Everything else is private and may change in any version:**" in PAGE


def test_the_page_tells_each_public_name_and_no_other() -> None:
    told = [name for title in ("Functions", "Classes") for name, _ in ROW.findall(SECTIONS[title])]
    assert sorted(name.strip("`").partition("(")[0] for name in told) == sorted(raytruth.__all__)
    assert sorted([*FUNCTIONS, *CLASSES]) == sorted(raytruth.__all__)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_page_tells_the_arguments_of_each_function(name: str) -> None:
    signature = inspect.signature(getattr(raytruth, name))
    bare = [parameter.replace(annotation=inspect.Parameter.empty) for parameter in signature.parameters.values()]
    expected = f"{name}{inspect.Signature(bare)}".replace("'", '"')
    assert f"| `{expected}` |" in SECTIONS["Functions"]


@pytest.mark.parametrize("name", CLASSES_WITH_FIELDS)
def test_the_page_tells_fields_that_there_are(name: str) -> None:
    known = getattr(raytruth, name)
    told = told_fields(name)
    assert told
    assert [field for field in told if field not in field_names(known) and not hasattr(known, field)] == []


@pytest.mark.parametrize("name", ["ImageJudgement", "WorstPixel", "OutputModel", "RayOffset"])
def test_the_page_leaves_no_field_out(name: str) -> None:
    assert field_names(getattr(raytruth, name)) - told_fields(name).keys() == set()


@pytest.mark.parametrize("name", ["ErrorModel", "RayOffset", "OutputModel"])
def test_the_page_tells_the_defaults_of_what_users_make(name: str) -> None:
    defaults = {field.name: field.default for field in fields(getattr(raytruth, name))}
    told = {name: cell.strip("`") for name, cell in told_fields(name).items() if cell.startswith("`")}
    assert told
    assert {name: ast.literal_eval(default) for name, default in told.items()} == {
        name: defaults[name] for name in told
    }


def test_the_example_prints_what_the_page_says() -> None:
    (printed,) = re.findall(r"```text\n(.*?)```", PAGE, flags=re.DOTALL)
    assert printed
    assert run_python("-c", example()) == printed


def test_a_type_checker_knows_what_each_function_takes_and_gives(tmp_path: Path) -> None:
    lines = [*example().splitlines(), *TYPES.splitlines()]
    checked = tmp_path / "checked.py"
    checked.write_text("\n".join([*lines, *WRONG_TYPES]), encoding="utf-8")
    told = run_python("-m", "mypy", str(checked), MYPYPATH=str(ROOT))
    errors = {int(number): text for number, text in re.findall(r"checked\.py:(\d+): error: (.*)", told)}
    expected = dict(enumerate(WRONG_TYPES.values(), start=len(lines) + 1))
    assert errors.keys() == expected.keys(), told
    assert all(errors[number].startswith(text) for number, text in expected.items()), told
