"""What a cell depends on, as a key: as long as that is the same, the cell need not be run again."""

from __future__ import annotations

import ast
import functools
import hashlib
import inspect
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.reference_tracer.storage.source_digest import ROOT, files_digest, source_digest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.renderers.protocol import Integrator, Renderer
    from raytruth.scenes.scene import Scene

APART = ("comparisons/renderers", "scenes/exporters")
"""Folders whose files belong to single renderers. All other code of ours belongs to every cell."""


def cell_key(scene: Scene, renderer: Renderer, integrator: Integrator, version: str | None) -> str:
    """Of the scene, the renderer's version, its adapter and exporter, and all code that judges."""
    judging = source_digest("scenes", "reference_tracer", "comparisons", without=APART)
    parts = (scene.model_dump_json(), renderer.name, integrator.name, str(version), judging, adapter_digest(renderer))
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def adapter_digest(renderer: Renderer) -> str:
    """Of the file of the renderer's class, and of those in the folders APART that it uses."""
    return _digest_with_imports(Path(inspect.getfile(type(renderer))))


@functools.cache
def _digest_with_imports(path: Path) -> str:
    return files_digest(sorted(files_used(path, ROOT)))


def files_used(path: Path, root: Path) -> set[Path]:
    """The file, and those in the folders APART under `root` that it imports or starts, directly or through others."""
    used: set[Path] = set()
    waiting = [path]
    while waiting:
        current = waiting.pop()
        if current not in used:
            used.add(current)
            waiting += _files_named(current, root)
    return used


def _files_named(path: Path, root: Path) -> Iterator[Path]:
    """The files APART whose modules a file names: in an import, or in a text, as with `python -m`."""
    for name in _names(ast.parse(path.read_text(encoding="utf-8"))):
        file = root / f"{name.replace('.', '/')}.py"
        if any(name.startswith(f"{folder.replace('/', '.')}.") for folder in APART) and file.is_file():
            yield file


def _names(module: ast.AST) -> Iterator[str]:
    """All that may be the name of a module: what is imported from a package may be one, too."""
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module is not None:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
