"""The catalogue is well formed: every fault stands in for a function that exists, and breaks a clause that exists."""

from __future__ import annotations

import ast
import inspect
import re
from collections import Counter
from pathlib import Path

import pytest

from raytruth.comparisons.faults.catalogue import all_faults
from raytruth.comparisons.faults.fault import Fault, Subject, fault, subjects_in
from raytruth.comparisons.faults.variants import all_variants
from raytruth.reference_tracer.arithmetics.edits import Edit, Function
from raytruth.reference_tracer.arithmetics.instantiation import SOURCE_FILES, source_module

pytestmark = pytest.mark.clause("PRJ-6")

ROOT = Path(__file__).parents[3]
CLAUSES = re.findall(r"^- \*\*([A-Z]+-\d+)\*\*", (ROOT / "docs" / "spec.md").read_text(encoding="utf-8"), re.MULTILINE)


def arguments_of_the_tracer() -> dict[str, list[str]]:
    """The names of the arguments of each function of the tracer's source."""
    found = {}
    for name in SOURCE_FILES:
        for node in ast.parse((ROOT / "reference_tracer" / "source" / f"{name}.py").read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef):
                found[node.name] = [argument.arg for argument in node.args.args]
    return found


def text_of(function: Function) -> str:
    """A function without its decorators, name, docstring and annotations."""
    (definition,) = ast.parse(inspect.getsource(function)).body
    assert isinstance(definition, ast.FunctionDef)
    body = definition.body[1:] if ast.get_docstring(definition) else definition.body
    return ast.unparse(body)  # type: ignore[arg-type] - it takes lists of statements, too


ARGUMENTS = arguments_of_the_tracer()
RIGHT = {node.name: ast.unparse(node.body) for node in source_module().body if isinstance(node, ast.FunctionDef)}  # type: ignore[arg-type] - as above
SUBJECTS: dict[str, Subject] = {**all_faults(), **all_variants()}


@pytest.mark.parametrize("name", SUBJECTS)
def test_what_stands_in_for_a_function_has_its_arguments(name: str) -> None:
    for function, body in SUBJECTS[name].overrides.items():
        assert list(inspect.signature(body).parameters) == ARGUMENTS[function]


@pytest.mark.parametrize("name", all_faults())
def test_a_fault_is_not_the_right_function(name: str) -> None:
    fault = all_faults()[name]
    differs = [text_of(body) != RIGHT[function] for function, body in fault.overrides.items()]
    assert any(differs) or fault.finish or fault.numbers == "float32"


def test_there_are_as_many_faults_and_variants_as_were_promised() -> None:
    assert len(all_faults()) >= 80
    assert len(all_variants()) >= 20
    assert not all_faults().keys() & all_variants().keys()


def test_every_clause_has_a_fault_and_no_fault_a_clause_that_does_not_exist() -> None:
    broken = {fault.clause for fault in all_faults().values()}
    assert broken == set(CLAUSES)


@pytest.mark.parametrize("name", SUBJECTS)
def test_words_are_one_sentence_of_their_own(name: str) -> None:
    words = SUBJECTS[name].words
    assert words
    assert Counter(subject.words for subject in SUBJECTS.values())[words] == 1
    if name in all_faults():
        assert words.endswith(".")
        assert all_faults()[name].hint.endswith(("?", "."))


def test_two_subjects_of_one_name_are_refused() -> None:
    class Module:
        one = Subject("same", "")
        two = Subject("same", "")

    with pytest.raises(ValueError, match="two subjects are called same"):
        subjects_in((Module,))  # type: ignore[arg-type]


def test_a_fault_is_its_function_and_what_is_said_about_it() -> None:
    def wrong(a: object) -> object:
        """It is
        wrong.
        """
        return a

    made = fault("CAM-1", "normalize", "Why?")(wrong)
    assert isinstance(made, Fault)
    assert (made.name, made.clause, made.words, made.hint) == ("wrong", "CAM-1", "It is wrong.", "Why?")
    assert made.overrides == {"normalize": wrong}
    assert "return a" in made.source()


def test_a_fault_by_edits_is_the_edited_function_and_what_is_said_about_it() -> None:
    def doubled() -> None:
        """It is doubled."""

    made = fault("CAM-1", "normalize", "Why?", Edit("1.0", "2.0"))(doubled)
    assert (made.name, made.words) == ("doubled", "It is doubled.")
    assert text_of(made.overrides["normalize"]) == "return scale(a, 2.0 / sqrt(dot(a, a)))"
    assert "2.0 / sqrt(dot(a, a))" in made.source()


def test_a_fault_that_has_both_a_function_and_edits_is_refused() -> None:
    def wrong(a: object) -> object:
        """It is wrong."""
        return a

    with pytest.raises(ValueError, match="wrong has both a body and edits"):
        fault("CAM-1", "normalize", "Why?", Edit("1.0", "2.0"))(wrong)


@pytest.mark.parametrize("name", all_faults())
def test_every_fault_has_a_hint_in_words_that_are_not_those_of_the_mistake(name: str) -> None:
    told = all_faults()[name]
    hint = re.findall(r"\w+", told.hint.lower())
    assert len(hint) >= 4  # fewer are a riddle
    assert told.hint.strip("?.").lower() not in told.words.lower()
    assert name not in told.hint.lower().replace(" ", "_")
