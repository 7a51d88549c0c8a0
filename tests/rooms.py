"""The rooms of the project, and what imports what: read from the sources, which are not imported."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parent.parent

# In this order: a room imports from itself and from rooms above it, and from no others.
ROOMS = (
    "scenes",
    "reference_tracer/storage",
    "reference_tracer/compiler",
    "reference_tracer/source",
    "reference_tracer/arithmetics",
    "reference_tracer",
    "comparisons/records",
    "comparisons/sandboxes",
    "comparisons/processes",
    "comparisons/attacks",
    "comparisons/error_models",
    "comparisons/noise",
    "comparisons/measures",
    "comparisons/feasible_sets",
    "comparisons/faults",
    "comparisons/renderers",
    "comparisons/oracle",
    "comparisons/judgement",
    "comparisons/matrix",
    "comparisons/kills",
    "comparisons/court",
    "comparisons/grading",
    "comparisons/classes",
    "specification",
    "reports",
    "raytruth",
    "benchmarks",
)
FOLDERS = tuple(dict.fromkeys(room.split("/")[0] for room in ROOMS))

Graph = dict[str, frozenset[str]]
"""The modules that each module imports, for type checking only, too; all of ours, by dotted names."""


def sources() -> list[Path]:
    """All Python files of the project but its tests, and but those that say what a folder holds and nothing else."""
    paths = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]
    return [path for path in paths if len(ast.parse(path.read_text(encoding="utf-8")).body) > 1]


def room_of(path: Path) -> str:
    """The room that a file lies in: the longest name that its folder begins with; its folder where it lies in none."""
    folder = path.parent.relative_to(ROOT).as_posix()
    rooms = [room for room in ROOMS if f"{folder}/".startswith(f"{room}/")]
    return max(rooms, key=len, default=folder)


def module_of(path: Path) -> str:
    """The dotted name that a file is imported by: our folders are parts of the package `raytruth`, by links in it."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    inside = parts if parts[0] in {"raytruth", "benchmarks"} else ("raytruth", *parts)
    return ".".join(inside[:-1] if inside[-1] == "__init__" else inside)


def imported_names(path: Path) -> set[str]:
    """Dotted names of all that a file imports: of `from a import b` it is a.b, a module or what is in one."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative imports hide the direction"
            assert node.module is not None
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


@cache
def import_graph() -> Graph:
    """Of all sources."""
    modules = {module_of(path): path for path in sources()}
    return {
        module: frozenset(found for name in imported_names(path) if (found := _module_in(name, modules)) is not None)
        for module, path in modules.items()
    }


def _module_in(name: str, modules: dict[str, Path]) -> str | None:
    """The module that a dotted name is, or is a name of; packages count only where they are imported themselves."""
    return next((known for known in (name, name.rpartition(".")[0]) if known in modules), None)


def levels(graph: Graph) -> dict[str, int]:
    """How many modules stand one on the other below each, itself included. Raises ValueError for a cycle."""
    found: dict[str, int] = {}
    left = dict(graph)
    while left:
        ready = [module for module, needs in left.items() if needs <= found.keys()]
        if not ready:
            raise ValueError(f"these modules import one another: {', '.join(sorted(left))}")
        for module in ready:
            found[module] = 1 + max((found[needed] for needed in left.pop(module)), default=0)
    return found


def main() -> None:
    """Print each module after the number of its level, the lowest first."""
    for module, level in sorted(levels(import_graph()).items(), key=lambda item: (item[1], item[0])):
        print(f"{level:3} {module}")


if __name__ == "__main__":
    main()
