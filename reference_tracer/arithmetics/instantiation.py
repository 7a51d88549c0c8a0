"""One source, many arithmetics: the tracer's source as a kernel for one number type and one set of features.

The source files are parsed and joined into one module, in which
- `if MIRRORS:` and the like are decided, so that the kernel holds what the scene requires and nothing else;
- a behaviour may put other functions in place of some, of the same signatures (behaviour.py);
- numeric literals are named constants, to be made of the kernel's number type;
- for balls, comparisons and powers are calls, to be decided by three-valued logic;
- for balls that follow a renderer's rounding, each result of an operation is rounded.

What comes out is a readable Python file, which is what runs and what the compiler sees.
"""

from __future__ import annotations

import ast
import copy
import inspect
import textwrap
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.reference_tracer.arithmetics.behaviour import IDEAL, inner_name
from raytruth.reference_tracer.arithmetics.source_changes import (
    ComparisonCalls,
    FeaturePruner,
    GuardedDivisions,
    LiteralNamer,
    Roundings,
)
from raytruth.reference_tracer.source import features as all_features

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from raytruth.reference_tracer.arithmetics.behaviour import Behaviour, Function

SOURCE_FOLDER = Path(all_features.__file__).parent
SOURCE_FEATURES = frozenset(name for name in vars(all_features) if name.isupper())
"""What the source knows that a scene may require."""

SOURCE_FILES = (
    "scene_data",
    "vector",
    "camera",
    "compensated",
    "sphere",
    "triangle",
    "plane",
    "bounding_volume",
    "traversal",
    "background",
    "texture",
    "reflection",
    "refraction",
    "shadow",
    "illumination",
    "dielectric",
    "ray_tree",
    "pixel_rows",
)

COMPILED_ENTRY_POINTS = ("render_rows", "first_hit_rows")
ENTRY_POINTS = (*COMPILED_ENTRY_POINTS, "camera_frame", "primary_ray", "hit_point", "radiance_at", "trace_ray")
"""What Python calls: compiled kernels offer less, since every entry point costs time to compile."""


@cache
def source_module() -> ast.Module:
    """All functions and whole-number constants of the source files, without docstrings, annotations and imports."""
    body: list[ast.stmt] = []
    for name in SOURCE_FILES:
        path = SOURCE_FOLDER / f"{name}.py"
        for statement in ast.parse(path.read_text(encoding="utf-8"), str(path)).body:
            if isinstance(statement, ast.FunctionDef):
                body.append(_bare(statement))
            elif isinstance(statement, ast.Assign) and isinstance(statement.value, ast.Constant | ast.UnaryOp):
                body.append(statement)
    return ast.Module(body=body, type_ignores=[])


@cache
def exact_functions() -> frozenset[str]:
    """The functions that only look numbers up: all their arithmetic is on whole numbers."""
    path = SOURCE_FOLDER / "scene_data.py"
    statements = ast.parse(path.read_text(encoding="utf-8")).body
    return frozenset(statement.name for statement in statements if isinstance(statement, ast.FunctionDef))


def kernel_source(
    features: Collection[str] | None,
    behaviour: Behaviour = IDEAL,
    *,
    entry_points: tuple[str, ...] = ENTRY_POINTS,
    decided_comparisons: bool = False,
    rounded_operations: bool = False,
    guarded_divisions: bool = False,
) -> tuple[str, dict[str, float]]:
    """The kernel as Python text, and the literals it uses by the names that they have in it.

    Without features nothing is left out: their names stay in the text, which asks them as it runs.
    The source of a behaviour's function is put in place of the function that it stands in for, under that function's
    name; helpers follow behind. All may use what the functions of the source may.
    Raises KeyError for a function that does not exist, or a feature that the source does not know; ValueError for a
    helper or a constant that already exists.
    """
    _, constants = _functions_and_constants(source_module())
    kept = None if features is None else frozenset(features)
    pruned, literals = _pruned_functions(kept)
    functions, namer = dict(pruned), LiteralNamer(dict(literals))
    helpers = {helper.__name__: helper for helper in behaviour.helpers}
    for name in (*helpers, *behaviour.constants):
        if name in pruned or name in constants:
            raise ValueError(f"the tracer's source and {behaviour.name} both say what {name} is")
    for name in behaviour.functions:
        if name not in pruned:
            raise KeyError(f"there is no function {name} in the tracer's source to override")
    pruner = FeaturePruner(_values_of(kept))
    for name, override in behaviour.functions.items():
        functions[name] = _PrunedFunction(namer.visit(pruner.prune(_override(name, override))))
    for name, helper in helpers.items():
        functions[name], its_literals = _pruned_helper(helper, kept)
        namer.names.update(its_literals)
    for name, outer in behaviour.around.items():
        if name in functions:  # a scene may not require it
            functions[inner_name(name)] = _renamed(functions[name], inner_name(name))
            functions[name] = _PrunedFunction(namer.visit(pruner.prune(_override(name, outer))))
    reached = _reachable(functions, entry_points)
    mentioned = frozenset().union(*(function.mentions for function in reached))
    parts = [ast.unparse(constant) for name, constant in constants.items() if name in mentioned]
    for function in reached:
        rounds = rounded_operations and function.definition.name not in exact_functions()
        wanted = {ComparisonCalls: decided_comparisons, Roundings: rounds, GuardedDivisions: guarded_divisions}
        parts.append(function.changed_text(tuple(change for change, is_wanted in wanted.items() if is_wanted)))
    return "\n".join(parts), {name: value for name, value in namer.names.items() if name in mentioned}


def _renamed(function: _PrunedFunction, name: str) -> _PrunedFunction:
    definition = copy.copy(function.definition)
    definition.name = name
    return _PrunedFunction(definition)


@cache
def functions_of(features: frozenset[str]) -> frozenset[str]:
    """The names of the functions that a kernel with these features holds: overriding another one changes nothing."""
    functions, _ = _pruned_functions(features)
    return frozenset(function.definition.name for function in _reachable(functions, ENTRY_POINTS))


class _PrunedFunction:
    """A function for some features, with its literals named. Many kernels share it, so it is not to be changed."""

    def __init__(self, definition: ast.FunctionDef) -> None:
        self.definition = definition
        self.mentions = frozenset(inner.id for inner in ast.walk(definition) if isinstance(inner, ast.Name))
        self._texts: dict[tuple[type[ast.NodeTransformer], ...], str] = {}

    def changed_text(self, changes: tuple[type[ast.NodeTransformer], ...]) -> str:
        """The function's text after these changes, one after the other; kept, since many kernels have it."""
        if changes not in self._texts:
            changed = copy.deepcopy(self.definition)
            for change in changes:
                changed = change().visit(changed)
            self._texts[changes] = ast.unparse(changed)
        return self._texts[changes]


@cache
def _pruned_functions(features: frozenset[str] | None) -> tuple[dict[str, _PrunedFunction], dict[str, float]]:
    """All functions for these features, and the values of their literals by name."""
    unknown = (features or frozenset()) - SOURCE_FEATURES
    if unknown:  # else what is new in scenes would be left out of every image without a word
        raise KeyError(f"the tracer's source knows no {', '.join(sorted(unknown))}")
    functions, _ = _functions_and_constants(source_module())
    pruner, namer = FeaturePruner(_values_of(features)), LiteralNamer({})
    pruned = {name: _PrunedFunction(namer.visit(pruner.prune(function))) for name, function in functions.items()}
    return pruned, namer.names


@cache
def _pruned_helper(function: Function, features: frozenset[str] | None) -> tuple[_PrunedFunction, dict[str, float]]:
    """A helper for these features, with its literals named; kept, since many kernels have the same ones."""
    namer = LiteralNamer({})
    pruned = FeaturePruner(_values_of(features)).prune(_override(function.__name__, function))
    return _PrunedFunction(namer.visit(pruned)), namer.names


def _values_of(features: frozenset[str] | None) -> dict[str, bool]:
    """Whether each feature is there, by name; none of them where that is known only as the kernel runs."""
    return {} if features is None else {name: name in features for name in SOURCE_FEATURES}


def _bare(function: ast.FunctionDef) -> ast.FunctionDef:
    """The function without docstring and annotations, whose names the kernel does not know."""
    bare: ast.FunctionDef = ast.parse(ast.unparse(function)).body[0]  # type: ignore[assignment]
    if ast.get_docstring(bare) is not None:
        bare.body = bare.body[1:]
    bare.returns = None
    for argument in bare.args.args:
        argument.annotation = None
    return bare


def _override(name: str, override: Callable[..., object]) -> ast.FunctionDef:
    definition = ast.parse(textwrap.dedent(inspect.getsource(override))).body[0]
    assert isinstance(definition, ast.FunctionDef), f"the override of {name} must be a plain function"
    bare = _bare(definition)
    bare.name = name
    bare.decorator_list = []
    return bare


def _functions_and_constants(module: ast.Module) -> tuple[dict[str, ast.FunctionDef], dict[str, ast.Assign]]:
    functions = {node.name: node for node in module.body if isinstance(node, ast.FunctionDef)}
    constants = {node.targets[0].id: node for node in module.body if isinstance(node, ast.Assign)}  # type: ignore[attr-defined]
    return functions, constants


def _reachable(functions: dict[str, _PrunedFunction], entry_points: tuple[str, ...]) -> list[_PrunedFunction]:
    """The functions that the entry points need, in the order of the source."""
    wanted: set[str] = set()
    waiting = list(entry_points)
    while waiting:
        name = waiting.pop()
        if name not in wanted:
            wanted.add(name)
            waiting.extend(functions[name].mentions & functions.keys())
    return [function for name, function in functions.items() if name in wanted]
