"""Which scenes of the library run which functions of the tracer."""

from __future__ import annotations

import ast
from collections import defaultdict

from reference_tracer.instantiation import COMPILED_ENTRY_POINTS, kernel_source
from scenes.library import library_names, open_scene
from scenes.requirements import required_features


def scenes_by_function() -> dict[str | None, tuple[str, ...]]:
    """The names of all scenes whose kernel holds a function, by its name; under None all scenes."""
    found: dict[str | None, list[str]] = defaultdict(list)
    for name in library_names():
        found[None].append(name)
        source, _ = kernel_source(required_features(open_scene(name)), entry_points=COMPILED_ENTRY_POINTS)
        for statement in ast.parse(source).body:
            if isinstance(statement, ast.FunctionDef):
                found[statement.name].append(name)
    return {function: tuple(names) for function, names in found.items()}
