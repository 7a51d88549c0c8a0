from __future__ import annotations

import ast
import inspect
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, make_kernel
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.edits import Edit, after, at_the_start, before, edited
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source, source_module
from raytruth.scenes.requirements import Feature

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("PRJ-6")

FUNCTIONS = [node.name for node in source_module().body if isinstance(node, ast.FunctionDef)]


def dot_in_a_loop(a: Any, b: Any) -> Any:
    """What may stand in for the tracer's dot."""
    total = 0.0
    for axis in range(3):
        total = total + a[axis] * b[axis]
    return total


def lines(function: Callable[..., Any]) -> list[str]:
    return [line.strip() for line in inspect.getsource(function).splitlines()[1:]]


def test_an_expression_is_replaced_and_nothing_else() -> None:
    right, wrong = lines(edited("camera_frame")), lines(edited("camera_frame", Edit("pi", "3.14")))
    assert [line for line in wrong if line not in right] == [
        "visible_height = 2.0 * tan(visible_height * 3.14 / 360.0)"
    ]
    assert len(wrong) == len(right)


def test_spaces_quotes_and_line_breaks_of_an_edit_do_not_matter() -> None:
    spread = Edit("\n        1.0/sqrt( dot(\n            a, a) )\n        ", "(2.0)")
    assert lines(edited("normalize", spread)) == ["return scale(a, 2.0)"]


def test_statements_are_put_before_and_after_others_at_the_start_and_in_place_of_others() -> None:
    statement = "origin, direction = primary_ray(frame, x, y)"
    first, medium, last = lines(edited("radiance_at"))
    assert first == statement
    assert lines(edited("radiance_at", at_the_start("x = y"))) == ["x = y", first, medium, last]
    assert lines(edited("radiance_at", before(medium, "x = y"))) == [first, "x = y", medium, last]
    assert lines(edited("radiance_at", after(medium, "x = y"))) == [first, medium, "x = y", last]
    assert lines(edited("radiance_at", Edit(f"{first}\n{medium}", "x = y"))) == ["x = y", last]
    assert lines(edited("radiance_at", Edit(medium, ""))) == [first, last]


def test_statements_may_be_indented_as_the_code_around_them_is() -> None:
    edit = before(
        """
        return scale(a, 1.0 / sqrt(dot(a, a)))
        """,
        """
        x = a[0]
        if x > 0.0:
            return a
        """,
    )
    assert lines(edited("normalize", edit)) == [
        "x = a[0]",
        "if x > 0.0:",
        "return a",
        "return scale(a, 1.0 / sqrt(dot(a, a)))",
    ]


def test_statements_are_found_in_inner_blocks_and_not_in_what_was_put_there() -> None:
    (statement,) = [line for line in lines(edited("attenuation")) if line == "return 1.0 / distance_squared"]
    wrapped = lines(edited("attenuation", Edit(statement, f"if light > 0:\n    {statement}")))
    assert wrapped.count("if light > 0:") == wrapped.count(statement) == 1


def test_edits_are_made_one_after_the_other() -> None:
    assert lines(edited("normalize", Edit("1.0", "2.0"), Edit("2.0", "3.0"))) == [
        "return scale(a, 3.0 / sqrt(dot(a, a)))"
    ]


def test_an_edit_of_several_places_says_of_how_many() -> None:
    assert lines(edited("medium_transmittance", Edit("distance", "1.0", times=3))) == [
        "return (exp(-absorption[0] * 1.0), exp(-absorption[1] * 1.0), exp(-absorption[2] * 1.0))"
    ]


@pytest.mark.parametrize(
    ("edit", "found"),
    [
        (Edit("exp(absorption[0])", "1.0"), 0),
        (Edit("distance", "1.0"), 3),
        (Edit("distance", "1.0", times=2), 3),
        (Edit("return 1.0", "return 2.0"), 0),
        (Edit("distance = 1.0", ""), 0),
    ],
)
def test_an_edit_of_what_is_not_there_so_many_times_is_refused(edit: Edit, found: int) -> None:
    with pytest.raises(ValueError, match=f"^medium_transmittance: expected .* found it {found} times$"):
        edited("medium_transmittance", edit)


def test_a_part_of_a_sum_is_not_found() -> None:
    assert lines(edited("dot")) == ["return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]"]
    with pytest.raises(ValueError, match="found it 0 times"):
        edited("dot", Edit("a[1] * b[1] + a[2] * b[2]", "0.0"))


@pytest.mark.parametrize("new", ["missing", "missing(a)", "missing + a[0]"])
def test_a_name_that_the_tracer_does_not_know_is_refused(new: str) -> None:
    with pytest.raises(ValueError, match=r"^normalize: the tracer does not know missing, which an edit uses$"):
        edited("normalize", Edit("1.0", new))


def test_an_edit_may_use_what_any_function_of_the_tracer_may() -> None:
    everything = "abs(inf) + cross(a, a)[0] + float(NOTHING) if SPHERES else 0.0"
    assert lines(edited("normalize", Edit("1.0", f"({everything})")))[0].count("cross") == 1


def test_a_function_that_the_tracer_does_not_have_is_refused() -> None:
    with pytest.raises(KeyError, match="missing"):
        edited("missing", Edit("1.0", "2.0"))


def test_another_function_than_the_tracers_can_be_edited() -> None:
    wrong = edited("dot", Edit("b[axis]", "b[2 - axis]"), of=dot_in_a_loop)
    assert lines(wrong) == [
        "total = 0.0",
        "for axis in range(3):",
        "total = total + a[axis] * b[2 - axis]",
        "return total",
    ]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_without_edits_a_function_is_the_tracers(name: str) -> None:
    everything = frozenset(Feature)
    assert kernel_source(everything, Behaviour({name: edited(name)})) == kernel_source(everything)


def test_an_edited_function_runs_in_a_kernel() -> None:
    reversed_normal = edited("negate", Edit("-a[1]", "a[1]"))
    kernel: Any = make_kernel(FLOAT, {"MIRRORS", "SPHERES"}, Behaviour({"negate": reversed_normal}))
    assert kernel.negate((1.0, 2.0, 3.0)) == (-1.0, 2.0, -3.0)
