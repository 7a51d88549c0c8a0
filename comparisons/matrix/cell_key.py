"""What a cell depends on, as a key: as long as that is the same, the cell need not be run again."""

from __future__ import annotations

import ast
import functools
import hashlib
import inspect
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.comparisons.feasible_sets.kept_feasible_sets import FEASIBLE_SET_ROOMS
from raytruth.comparisons.renderers.protocol import GivenRenderer
from raytruth.reference_tracer.storage.source_digest import ROOT, files_digest, source_digest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.renderers.protocol import Integrator, Renderer
    from raytruth.scenes.scene import Scene

CELL_ROOMS = (
    *FEASIBLE_SET_ROOMS,
    "comparisons/judgement",
    "comparisons/matrix",
    "comparisons/measures",
    "comparisons/noise",
    "comparisons/processes",
    "comparisons/records",
    "comparisons/renderers/protocol.py",
    "comparisons/sandboxes",
)
"""What every cell depends on: the truth, the feasible set, and how a renderer is run, judged and measured."""

ADAPTERS = ("comparisons/renderers", "scenes/exporters")
"""Folders whose files belong to single renderers, and so to their cells alone."""


def scene_digest(scene: Scene) -> str:
    """A digest of all that a scene says, its name included."""
    return hashlib.sha256(scene.model_dump_json().encode()).hexdigest()


def cell_key(of_scene: str, renderer: Renderer, integrator: Integrator, version: str | None) -> str:
    """A digest of all that a cell depends on.

    That are the scene, by its `scene_digest`, the renderer's version, its adapter and exporter, and the code in
    CELL_ROOMS.
    """
    judging = source_digest(*CELL_ROOMS)
    parts = (of_scene, renderer.name, integrator.name, str(version), judging, adapter_digest(renderer))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def adapter_digest(renderer: Renderer) -> str:
    """A digest of the file of the renderer's class, and of those in the folders ADAPTERS that it uses.

    Of a renderer that its user gives it is another when that is another.
    """
    code = _digest_with_imports(Path(inspect.getfile(type(renderer))))
    return f"{code} {renderer.digest}" if isinstance(renderer, GivenRenderer) else code


@functools.cache
def _digest_with_imports(path: Path) -> str:
    return files_digest(sorted(files_used(path, ROOT)))


def files_used(path: Path, root: Path, folders: tuple[str, ...] = ADAPTERS) -> set[Path]:
    """The file itself, and files in the folders that it imports or starts, directly or through others of them.

    `root` is the folder of the package `raytruth`, and `folders` are relative to it.
    """
    used: set[Path] = set()
    waiting = [path]
    while waiting:
        current = waiting.pop()
        if current not in used:
            used.add(current)
            waiting += (file for file in _files_named(current, root) if _is_in(file.relative_to(root), folders))
    return used


def _is_in(file: Path, folders: tuple[str, ...]) -> bool:
    return any(file.is_relative_to(folder) for folder in folders)


def _files_named(path: Path, root: Path) -> Iterator[Path]:
    """Our files whose modules a file names: in an import, or in a text, as with `python -m`."""
    for name in _names(ast.parse(path.read_bytes())):
        package, _, module = name.partition(".")
        file = root / f"{module.replace('.', '/')}.py"
        if package == "raytruth" and file.is_file():
            yield file


def _names(node: ast.AST) -> Iterator[str]:
    """All that may be the name of a module: what is imported from a package may be one, too."""
    if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
        return  # what is imported for a type is not run
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom) and node.module is not None:
        yield node.module
        yield from (f"{node.module}.{alias.name}" for alias in node.names)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    for child in ast.iter_child_nodes(node):
        yield from _names(child)
