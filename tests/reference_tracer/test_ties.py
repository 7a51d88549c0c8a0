from __future__ import annotations

import ast
from functools import cache

import pytest
from flint import arb

from raytruth.reference_tracer.arithmetics.arithmetic import make_kernel
from raytruth.reference_tracer.arithmetics.balls import ball_arithmetic
from raytruth.reference_tracer.arithmetics.behaviour import Behaviour
from raytruth.reference_tracer.arithmetics.instantiation import kernel_source
from raytruth.reference_tracer.arithmetics.source_changes import COMPARISONS
from raytruth.reference_tracer.arithmetics.textbook_forms import PLAIN_FORMS
from raytruth.reference_tracer.ties import (
    MEANINGS,
    NO_BOUND,
    NotedDecisions,
    RaisingDecisions,
    UndecidedComparisonError,
    explanation,
    sentence,
)
from raytruth.scenes.features import Feature

pytestmark = pytest.mark.clause("ARI-3")

DECIDING = {*COMPARISONS.values(), "floor"}
# Their comparisons are of numbers of primitives, materials and rays, which are whole and so always decided.
OF_WHOLE_NUMBERS = {"distance_to_plane", "distance_to_sphere", "material_of", "radiance", "surface_normal", "textured"}
# Balls replace these by functions that are True only where it is certain (test below).
REPLACED = {"certainly_less", "certainly_zero"}


@cache
def ball_source() -> ast.Module:
    """What runs in balls, with all features."""
    text, _ = kernel_source(set(Feature), Behaviour(PLAIN_FORMS), decided_comparisons=True)
    return ast.parse(text)


def called_names(node: ast.AST) -> set[str]:
    return {
        inner.func.id for inner in ast.walk(node) if isinstance(inner, ast.Call) and isinstance(inner.func, ast.Name)
    }


def functions() -> list[ast.FunctionDef]:
    return [node for node in ball_source().body if isinstance(node, ast.FunctionDef)]


def test_each_function_that_compares_numbers_has_a_sentence() -> None:
    comparing = {function.name for function in functions() if called_names(function) & DECIDING}
    assert comparing - OF_WHOLE_NUMBERS - REPLACED <= MEANINGS.keys()
    assert comparing >= OF_WHOLE_NUMBERS
    assert MEANINGS.keys() <= {function.name for function in functions()}


def test_no_bare_comparison_is_left_to_the_balls() -> None:
    assert [ast.unparse(node) for node in ast.walk(ball_source()) if isinstance(node, ast.Compare)] == []


def test_every_condition_is_a_decision_or_a_flag_and_never_a_number() -> None:
    of_scene = {"integer_of"}
    predicates = {"box_is_missed", "is_even_square", "is_occluded", "is_shadowed", *REPLACED}
    allowed = {*COMPARISONS.values(), *of_scene, *predicates}

    flags = {"entering", "light_is_near"}  # a result and an argument

    def is_decided(test: ast.expr) -> bool:
        if isinstance(test, ast.BoolOp):
            return all(map(is_decided, test.values))
        if isinstance(test, ast.UnaryOp):
            return is_decided(test.operand)
        if isinstance(test, ast.Call):
            return isinstance(test.func, ast.Name) and test.func.id in allowed
        return isinstance(test, ast.Name) and test.id in flags

    for node in ast.walk(ball_source()):
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name) and is_decided(node.value):
            flags.add(node.targets[0].id)
    conditions = [node.test for node in ast.walk(ball_source()) if isinstance(node, ast.If | ast.IfExp | ast.While)]
    assert conditions
    assert [ast.unparse(test) for test in conditions if not is_decided(test)] == []


def test_what_the_source_calls_but_does_not_define_comes_from_the_ball_arithmetic() -> None:
    whole_numbers_only = {"float", "len", "range"}
    defined = {function.name for function in functions()}
    table = ball_arithmetic(128, RaisingDecisions()).functions.keys()
    missing = called_names(ball_source()) - defined - table - whole_numbers_only
    # The absolute value of a ball is a ball that holds those of its points.
    assert missing <= {"abs"}
    assert table >= REPLACED


@pytest.mark.parametrize(
    ("a", "b", "certain"),
    [((0, 1), (2, 3), True), ((0, 1), (1, 2), False), ((0, 2), (1, 3), False), ((2, 3), (0, 1), False)],
)
def test_certainly_less_is_true_only_if_it_holds_for_all_points(
    a: tuple[int, int], b: tuple[int, int], certain: bool
) -> None:
    certainly_less = ball_arithmetic(128, RaisingDecisions()).functions["certainly_less"]
    left, right = (arb((low + high) / 2, (high - low) / 2) for low, high in (a, b))
    assert certainly_less(left, right) is certain


def test_certainly_zero_is_true_only_of_zero_itself() -> None:
    certainly_zero = ball_arithmetic(128, RaisingDecisions()).functions["certainly_zero"]
    assert certainly_zero(arb(0))
    assert not certainly_zero(arb(0, 2.0**-1000))
    assert not certainly_zero(arb(1) / arb(0))


@pytest.mark.parametrize("name", [*COMPARISONS.values()])
@pytest.mark.parametrize("other", ["overlapping", "not a number"])
def test_an_undecided_comparison_raises_and_takes_no_branch(name: str, other: str) -> None:
    decide = ball_arithmetic(128, RaisingDecisions()).functions[name]
    ball = arb(0, 1) if other == "overlapping" else arb("nan")
    with pytest.raises(UndecidedComparisonError):
        decide(ball, arb(0))
    with pytest.raises(UndecidedComparisonError):
        decide(arb(0), ball)


@pytest.mark.parametrize("x", [arb(3, 2.0**-1000), arb("nan"), arb("inf")])
def test_an_undecided_floor_raises(x: arb) -> None:
    with pytest.raises(UndecidedComparisonError):
        ball_arithmetic(2000, RaisingDecisions()).functions["floor"](x)


def test_infinities_are_ordered_without_a_decision() -> None:
    table = ball_arithmetic(128, RaisingDecisions()).functions
    infinity = table["inf"]
    assert not table["is_less"](infinity, infinity)
    assert table["is_less"](arb(1), infinity)
    assert not table["is_less"](infinity, arb(1))


def test_the_sentence_names_the_function_that_asked_and_whose_ray_it_was() -> None:
    decisions = NotedDecisions()
    kernel = make_kernel(ball_arithmetic(128, decisions), set(Feature))
    zero = arb(0, 2.0**-200)
    kernel.fresnel_reflectance(zero, arb(1), arb(2))
    assert decisions.sentences == {"the ray meets a dielectric exactly along its surface"}
    assert sentence("sphere_distance", of_shadow_ray=True).startswith("the shadow ray touches a sphere")
    assert "unheard_of" in sentence("unheard_of", of_shadow_ray=False)


def test_an_explanation_has_each_tie_once_and_says_so_if_there_is_none() -> None:
    assert explanation({"b", "a"}) == "a; b"
    assert explanation([]) == NO_BOUND
