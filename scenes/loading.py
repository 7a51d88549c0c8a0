"""Loads scene files. They are untrusted: whatever a file holds, the answer is a Scene or a SceneError."""

from __future__ import annotations

import json
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from pydantic import TypeAdapter, ValidationError

from raytruth.scenes.camera import Camera, CameraBase
from raytruth.scenes.consistency import Parts, inconsistencies, parts_of
from raytruth.scenes.lights import Light
from raytruth.scenes.materials import Material
from raytruth.scenes.mesh_files import with_triangles
from raytruth.scenes.scene import Scene
from raytruth.scenes.shapes import Mesh, Shape
from raytruth.scenes.triangle_lists import LARGEST_FACE_COUNT, MeshFileError
from raytruth.scenes.validation import Location, problems_of
from raytruth.scenes.values import Color
from raytruth.scenes.wording import place, quoted

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from raytruth.scenes.consistency import Problem

# An inline mesh of 10,000 faces fits. Every broken item costs pydantic some 2 kB: measured, the worst text of this size
# (all empty objects) is refused within 12 s and 0.9 GB, and eight times as much text takes eight times as much.
LARGEST_SCENE_FILE = 2**20
# More problems than a person reads at once; a broken mesh can have hundreds of thousands.
MOST_PROBLEMS_TOLD = 100
# Reading the largest mesh file takes seconds, and a small scene file could name it thousands of times.
MOST_MESH_FILES = 100
# Whole numbers with more digits are absurd, and Python's time to read them grows with the square of their length.
LONGEST_WHOLE_NUMBER = 20

# UTF-8 cannot say it, so that no file could be written that holds such a text.
_LONE_SURROGATE = re.compile("[\ud800-\udfff]")

K = TypeVar("K")
T = TypeVar("T")

_CAMERA: TypeAdapter[CameraBase] = TypeAdapter(Camera)
_COLOR: TypeAdapter[Color] = TypeAdapter(Color)
_LIGHT: TypeAdapter[Light] = TypeAdapter(Light)
_MATERIAL: TypeAdapter[Material] = TypeAdapter(Material)
_SHAPE: TypeAdapter[Shape] = TypeAdapter(Shape)


class SceneError(Exception):
    """A scene cannot be used; `problems` has one sentence for each thing to mend."""

    def __init__(self, problems: Iterable[str]) -> None:
        """Keeps the sentences; the exception's text has one on each line."""
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class _Object(dict[str, Any]):
    """A JSON object that remembers which keys were stated more than once."""

    def __init__(self, pairs: list[tuple[str, Any]]) -> None:
        super().__init__(pairs)
        self.repeated = {key for key, times in Counter(key for key, _ in pairs).items() if times > 1}


def load_scene(path: Path | str) -> Scene:
    """The scene in a JSON file, with the triangles of its mesh files; its name is the file's name without ending.

    Raises SceneError, which holds a sentence for every problem of the file and of its mesh files.
    """
    path = Path(path)
    data = _parsed(path)
    if path.stem in {".", ".."}:  # `...json`: results are written to a folder of the scene's name
        raise SceneError((f"{path}: expected a file name with something before .json; rename it.",))
    if _LONE_SURROGATE.search(path.stem):
        raise SceneError((f"{quoted(str(path))}: expected a file name in UTF-8, since it names the scene; rename it.",))
    problems = [(place(where), "expected each key once, found it again; remove one.") for where in _repeated_keys(data)]
    no_text = {place(where): what for where, what in _lone_surrogates(data)}
    if isinstance(data, dict) and "name" in data:
        problems.append(("name", "expected no name, since a scene is named after its file; remove it."))
    scene = None
    try:
        scene = Scene.model_validate(data)
        parts = parts_of(scene)
    except ValidationError as error:
        problems += problems_of(error)
        parts = _valid_parts(data)
    objects, mesh_problems = _with_mesh_files(parts.objects, path.parent)
    problems += mesh_problems
    parts = replace(parts, objects=objects)
    problems += inconsistencies(parts)
    problems = [*no_text.items(), *(problem for problem in problems if problem[0] not in no_text)]
    if scene is None or problems:
        raise SceneError(_told(path, problems))
    return scene.model_copy(update={"name": path.stem, "objects": tuple(objects.values())})


def _parsed(path: Path) -> Any:
    text = _text(path)
    try:
        return json.loads(text, object_pairs_hook=_Object, parse_int=_whole_number)
    except json.JSONDecodeError as error:
        place_of_error = f"line {error.lineno}, column {error.colno}"
        raise SceneError([f"{path}: {place_of_error}: expected valid JSON, found a mistake: {error.msg}."]) from error
    except RecursionError as error:
        raise SceneError([f"{path}: expected a scene, found brackets nested too deeply for one."]) from error


def _text(path: Path) -> str:
    try:
        if path.exists() and not path.is_file():
            raise SceneError([f"{path}: expected a scene file, found a folder or a device."])
        with path.open("rb") as file:
            content = file.read(LARGEST_SCENE_FILE + 1)
    except FileNotFoundError as error:
        raise SceneError([f"{path}: expected a scene file, found no file of this name."]) from error
    except (OSError, ValueError, RuntimeError) as error:
        # ValueError: a NUL character in the name; RuntimeError: symbolic links that run in a circle.
        raise SceneError([f"{quoted(str(path))}: expected a readable scene file, but {error}."]) from error
    if len(content) > LARGEST_SCENE_FILE:
        raise SceneError(
            [
                f"{path}: expected at most {LARGEST_SCENE_FILE // 2**20} MiB, which bounds the memory that reading "
                "takes, found more; put large meshes into an OBJ or PLY file beside the scene."
            ]
        )
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise SceneError(
            [f"{path}: expected text in UTF-8, found byte {error.start} that is not; save it so."]
        ) from error


def _whole_number(digits: str) -> float:
    # As a float an absurd number is refused at its place, like any other that is too large.
    return int(digits) if len(digits) <= LONGEST_WHOLE_NUMBER else float(digits)


def _repeated_keys(data: Any) -> Iterator[Location]:
    for where, value in _walk(data):
        if isinstance(value, _Object):
            for key in sorted(value.repeated):
                yield (*where, key)


def _lone_surrogates(data: Any) -> Iterator[tuple[Location, str]]:
    """(place, sentence) of each key or text that is no Unicode text: JSON can state half a character of UTF-16."""
    for where, value in _walk(data):
        texts = {(*where, key): key for key in value} if isinstance(value, dict) else {where: value}
        for location, text in texts.items():
            if isinstance(text, str) and _LONE_SURROGATE.search(text):
                yield (
                    location,
                    (
                        f"expected a text of Unicode characters, found {quoted(text)}, which holds half of one "
                        "(a lone surrogate); replace it."
                    ),
                )


def _walk(data: Any) -> Iterator[tuple[Location, Any]]:
    """The place and value of each object, list and text."""
    pending: list[tuple[Location, Any]] = [((), data)]
    while pending:
        where, value = pending.pop()
        yield where, value
        members = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        pending += [((*where, key), inner) for key, inner in members if isinstance(inner, dict | list | str)]


def _valid_parts(data: Any) -> Parts:
    """What can be checked further of a scene that is not valid as a whole."""
    stated = _members(data)
    convention = stated.get("convention")
    stated_materials = _members(stated.get("materials"))
    materials = _valid_items(_MATERIAL, stated_materials)
    return Parts(
        convention=convention if isinstance(convention, str) else None,
        camera=_valid(_CAMERA, stated.get("camera")),
        ambient_light=_valid(_COLOR, stated.get("ambient_light")),
        lights=_valid_items(_LIGHT, _items(stated.get("lights"))),
        materials=materials,
        broken_materials=frozenset(stated_materials.keys() - materials.keys()),
        objects=_valid_items(_SHAPE, _items(stated.get("objects"))),
    )


def _valid(adapter: TypeAdapter[T], value: Any) -> T | None:
    try:
        return adapter.validate_python(value)
    except ValidationError:
        return None


def _valid_items(adapter: TypeAdapter[T], values: dict[K, Any]) -> dict[K, T]:
    candidates = {key: _valid(adapter, value) for key, value in values.items()}
    return {key: value for key, value in candidates.items() if value is not None}


def _members(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _items(value: Any) -> dict[int, Any]:
    return dict(enumerate(value)) if isinstance(value, list) else {}


def _with_mesh_files(objects: Mapping[int, Shape], folder: Path) -> tuple[dict[int, Shape], list[Problem]]:
    meshes = {index: shape for index, shape in objects.items() if isinstance(shape, Mesh)}
    if sum(mesh.file is not None for mesh in meshes.values()) > MOST_MESH_FILES:
        return dict(objects), [("objects", f"expected at most {MOST_MESH_FILES} mesh files, found more; join some.")]
    loaded = dict(objects)
    problems: list[Problem] = []
    faces = 0
    for index, mesh in meshes.items():
        try:
            with_file = with_triangles(mesh, folder)
        except MeshFileError as error:
            where = f"objects[{index}].file" if mesh.file is not None else f"objects[{index}]"
            problems.append((where, str(error)))
            # Its triangles are unknown, but its material can be checked.
            with_file = mesh.model_copy(update={"vertices": (), "faces": ()})
        loaded[index] = with_file
        faces += len(with_file.faces)
        if faces > LARGEST_FACE_COUNT:
            problems.append(("objects", f"expected at most {LARGEST_FACE_COUNT} triangles in all meshes, found more."))
            break
    return loaded, problems


def _told(path: Path, problems: list[Problem]) -> list[str]:
    sentences = [f"{path}: {where}: {what}" for where, what in problems[:MOST_PROBLEMS_TOLD]]
    if len(problems) > MOST_PROBLEMS_TOLD:
        sentences.append(f"{path}: {len(problems) - MOST_PROBLEMS_TOLD} more problems like these were found.")
    return sentences
