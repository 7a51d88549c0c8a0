"""All mutants of the tracer's physics: its source with one operator, number or condition replaced by cosmic-ray."""

from __future__ import annotations

import ast
import hashlib
import re
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.ast.ast_query import ASTQuery
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names

from raytruth.reference_tracer.arithmetics.instantiation import SOURCE_FILES
from tests.rooms import ROOT

if TYPE_CHECKING:
    from pathlib import Path

# What kernels are made of, without scene_data.py: that is the numbering of tables, which holds no physics.
PHYSICS = tuple(file for file in SOURCE_FILES if file != "scene_data")

# Left out: what floats have no meaning for (bits, shifts, identity), and whole parts and powers in place of a sum,
# which any test at all notices. They would only flatter the score.
LEFT_OUT = re.compile(
    r"Bit|Shift|Invert|Is|FloorDiv|Mod|_Pow$|UAdd|USub_Not|Variable|Exception|Decorator|Break|Continue"
)
# Imports for type checking alone are not part of the program.
NOT_RUN = re.compile(r"if TYPE_CHECKING:")


@dataclass(frozen=True)
class Mutant:
    """One change to one file."""

    file: str
    """Without its ending, as in `sphere`."""
    operator: str
    occurrence: int
    """The operator's how many-eth place in the file; with the operator it names the mutant to cosmic-ray."""
    function: str
    """The function it is in; empty for a constant of the file."""
    line: int
    before: str
    after: str
    """The line before and after, without indentation."""

    @property
    def key(self) -> str:
        """What names it to a reader, whatever happens to the lines above; a line may stand twice in a function."""
        return f"{self.function or 'constant'}: {self.before} → {self.after}"

    def source(self) -> str:
        """The whole file, mutated."""
        mutated: str = mutate_code(text_of(self.file), get_operator(self.operator)(), self.occurrence)
        return mutated


def path_of(file: str) -> Path:
    """Where that file of the tracer is."""
    return ROOT / "reference_tracer" / "source" / f"{file}.py"


@cache
def text_of(file: str) -> str:
    return path_of(file).read_text(encoding="utf-8")


def digest_of(file: str) -> str:
    """Tells whether the program has changed since its mutants were judged: imports and comments are none of it."""
    return hashlib.sha256(program_of(text_of(file)).encode()).hexdigest()[:16]


def program_of(text: str) -> str:
    """The functions and constants of a file, without comments and docstrings."""
    kept = [node for node in ast.parse(text).body if isinstance(node, ast.FunctionDef | ast.Assign | ast.AnnAssign)]
    for node in kept:
        if isinstance(node, ast.FunctionDef) and ast.get_docstring(node) is not None:
            node.body = node.body[1:]
    return ast.unparse(ast.Module(body=kept, type_ignores=[]))


def mutants_of(file: str) -> list[Mutant]:
    """All mutants of a file, in the order of its lines; two operators that change the same to the same are one."""
    lines = text_of(file).splitlines()
    nodes = list(ast_nodes(get_ast(text_of(file))))
    found: dict[str, Mutant] = {}
    for name in operator_names():
        if LEFT_OUT.search(name):
            continue
        operator = get_operator(name)()
        places = ((node, start) for node in nodes for start, _ in operator.mutation_positions(node))
        for occurrence, (node, (line, _)) in enumerate(places):
            before = lines[line - 1].strip()
            if NOT_RUN.match(before):
                continue
            mutated = mutate_code(text_of(file), operator, occurrence)
            after = mutated.splitlines()[line - 1].strip()
            function = ASTQuery(node).get_definition_name() or ""
            found.setdefault(mutated, Mutant(file, name, occurrence, function, line, before, after))
    return sorted(found.values(), key=lambda mutant: mutant.line)
