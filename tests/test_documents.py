"""The documents say what the code does."""

from __future__ import annotations

import json
import re
import tomllib
from collections import Counter
from importlib.metadata import metadata, requires
from typing import TYPE_CHECKING, Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from raytruth.scenes.loading import load_scene
from raytruth.scenes.schema import json_schema
from raytruth.specification.clauses import PROMISES, SPECIFICATION, all_clauses, clauses_of
from tests.rooms import FOLDERS, ROOMS, ROOT, sources

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("PRJ-2")

DOCUMENTS = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").glob("*.md"))]
README = (ROOT / "README.md").read_text(encoding="utf-8")
SCENE_FORMAT = (ROOT / "docs" / "scene-format.md").read_text(encoding="utf-8")

SCHEMA = json_schema()
MODELS: dict[str, dict[str, Any]] = {"Scene": SCHEMA, **SCHEMA["$defs"]}

DEPENDENCIES = (ROOT / "docs" / "dependencies.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
# The library in its wheel may be replaced by the user's own, as the LGPL asks; nothing of it is in our code.
LESSER = {"python-flint"}

# A file as it is named in a text: a Python file by its name alone, or by the end of its path, others by a path.
FILE = re.compile(r"(?<![\w./$*-])(?:(?:[\w.-]+/)*[\w-]+\.py|(?:[\w.-]+/)+[\w-]+\.(?:json|md|jinja|js|css))\b")
NOT_OURS = {"runtestsuites.py", "class/ben/tracer.py", "tracer.py"}  # appleseed's, and students'

ROW = re.compile(r"^\| `(\w+)` \| .+ \| (.+) \| .*\|$", re.MULTILINE)


def section(title: str) -> str:
    """The text under a heading of the scene format, up to the next heading; `Point light` describes PointLight."""
    for part in re.split(r"^#+ ", SCENE_FORMAT, flags=re.MULTILINE):
        heading, _, text = part.partition("\n")
        if heading.replace(" ", "").lower() == title.lower():
            return text
    raise AssertionError(f"docs/scene-format.md has no section on {title}")


@pytest.mark.clause("SCN-4")
@pytest.mark.parametrize("name", MODELS)
def test_the_scene_format_tells_every_key_and_its_default(name: str) -> None:
    told = dict(ROW.findall(section(name)))
    model = MODELS[name]
    assert told.keys() == model["properties"].keys()
    for key, default in told.items():
        assert (default == "required") == (key in model.get("required", [])), key
        if default.startswith("`"):
            assert json.loads(default.strip("`")) == model["properties"][key]["default"], key


def test_the_example_of_the_scene_format_is_a_scene(tmp_path: Path) -> None:
    (example,) = re.findall(r"```json\n(.*?)```", SCENE_FORMAT, flags=re.DOTALL)
    path = tmp_path / "example.json"
    path.write_text(example, encoding="utf-8")
    assert load_scene(path).name == "example"


def test_each_clause_has_one_place_in_order() -> None:
    clauses = (*clauses_of(ROOT, SPECIFICATION), *clauses_of(ROOT, PROMISES))
    assert [clause for clause, times in Counter(clauses).items() if times > 1] == []
    numbers: dict[str, list[int]] = {}
    for prefix, number in (clause.split("-") for clause in clauses):
        numbers.setdefault(prefix, []).append(int(number))
    assert all(found == list(range(1, len(found) + 1)) for found in numbers.values())


def test_whatever_refers_to_a_clause_or_chapter_refers_to_one_that_exists() -> None:
    clauses = all_clauses(ROOT)
    chapters = {clause.split("-")[0] for clause in clauses}
    sources = [path.read_text(encoding="utf-8") for path in (ROOT / "reference_tracer").rglob("*.py")]
    named_by_sources = {name for text in sources for name in re.findall(r"docs/spec\.md, ([A-Z]+)\b", text)}
    assert named_by_sources
    assert named_by_sources <= {clause.split("-")[0] for clause in clauses_of(ROOT, SPECIFICATION)}
    mentions = re.findall(
        rf"\b(?:{'|'.join(chapters)})-\d+\b", "".join(path.read_text(encoding="utf-8") for path in DOCUMENTS)
    )
    assert set(mentions) <= clauses
    assert set(re.findall(r"\[([A-Z]+)\]", SCENE_FORMAT)) <= chapters


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_every_link_to_a_file_leads_somewhere(path: Path) -> None:
    links = re.findall(r"\]\(([^)\s]+)\)", path.read_text(encoding="utf-8"))
    local = [link.partition("#")[0] for link in links if "://" not in link]
    assert [link for link in local if not (path.parent / link).exists()] == []


def test_the_folders_and_rooms_of_the_readme_are_those_that_are_there_in_their_order() -> None:
    folders, rooms = re.findall(r"\| (?:folder|room) .+\n\|[-|]+\n((?:\|.+\n)+)", README)
    assert tuple(re.findall(r"^\| `(\w+)/`", folders, re.MULTILINE)) == (*FOLDERS[:-1], "tests", FOLDERS[-1])
    of_comparisons = [room.removeprefix("comparisons/") for room in ROOMS if room.startswith("comparisons/")]
    assert re.findall(r"^\| `(\w+)/`", rooms, re.MULTILINE) == of_comparisons


def test_every_file_that_a_document_or_a_comment_names_exists() -> None:
    here = [path for folder in (*FOLDERS, "tests", "docs", "tools") for path in (ROOT / folder).rglob("*.*")]
    endings = {"/".join(path.relative_to(ROOT).parts[start:]) for path in here for start in range(len(path.parts))}
    named: dict[str, Path] = {}
    for path in [*DOCUMENTS, *(ROOT / "tests").glob("*.md"), *sources()]:
        mentions = FILE.findall(path.read_text(encoding="utf-8"))
        named |= {mention: path for mention in mentions if mention.endswith(".py") or mention.split("/")[0] in FOLDERS}
    assert "reference_tracer/source/illumination.py" in named
    # In capitals is what a reader puts a name of his own for.
    missing = {name: path for name, path in named.items() if name not in endings and not re.search(r"[A-Z]{4}", name)}
    assert missing.keys() == NOT_OURS


@pytest.mark.clause("PRJ-4")
def test_the_dependencies_are_told_and_constrained() -> None:
    # Blender, which asks for NumPy 1, is installed beside what the tests ask for (docs/dependencies.md).
    extras = PROJECT["optional-dependencies"]
    stated = {Requirement(line).name for line in [*PROJECT["dependencies"], *extras["test"], *extras["cycles"]]}
    assert set(re.findall(r"^\| ([a-z][a-z0-9-]+) \| (?!licence)", DEPENDENCIES, flags=re.MULTILINE)) == stated
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    assert stated <= {canonicalize_name(line.partition("==")[0]) for line in lines}


@pytest.mark.clause("PRJ-4")
def test_no_dependency_brings_a_licence_that_ours_cannot_carry() -> None:
    waiting = [Requirement(line) for line in PROJECT["dependencies"]]
    seen: set[str] = set()
    while waiting:
        requirement = waiting.pop()
        name = canonicalize_name(requirement.name)
        if name in seen or (requirement.marker and not requirement.marker.evaluate({"extra": ""})):
            continue
        seen.add(name)
        found = metadata(name)
        # A field may hold the licence's whole text, whose first line names it.
        names = [found.get("License-Expression") or "", (found.get("License") or "").partition("\n")[0]]
        names += [value for value in found.get_all("Classifier") or [] if value.startswith("License ::")]
        assert any(names) or name in LESSER, f"{name} states no licence"
        assert name in LESSER or not re.search(r"GPL|General Public", " ".join(names)), f"{name}: {names}"
        waiting += map(Requirement, requires(name) or [])
    assert len(seen) > len(PROJECT["dependencies"])
