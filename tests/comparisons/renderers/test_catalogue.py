from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.renderers.catalogue import (
    UnknownRendererError,
    all_renderers,
    family_of,
    select_renderers,
)
from tests.comparisons.renderers.program.scripts import program

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REN-5")


def test_every_renderer_stands_under_its_name() -> None:
    assert {"mitsuba", "mitsuba-llvm", "povray", "cycles", "closed_form", "raytruth"} <= all_renderers().keys()
    for name, renderer in all_renderers().items():
        assert renderer.name == name
        assert renderer.install
        assert renderer.integrators


def test_a_selection_keeps_the_order_asked_for_and_each_once() -> None:
    assert list(select_renderers(["raytruth", "mitsuba", "raytruth"])) == ["raytruth", "mitsuba"]


def test_no_names_select_all() -> None:
    assert select_renderers([]).keys() == all_renderers().keys()


def test_an_unknown_name_is_refused_with_a_suggestion() -> None:
    with pytest.raises(UnknownRendererError, match="did you mean 'mitsuba'"):
        select_renderers(["mitsuba", "mitsbua"])


@pytest.mark.clause("REP-7")
def test_a_users_program_is_no_opinion_unless_it_is_declared_to_be_a_reference(tmp_path: Path) -> None:
    assert family_of(program(tmp_path)) is None
    assert family_of(program(tmp_path, reference=True)) == "mine"
    assert family_of(program(tmp_path, reference=True, family="ours")) == "ours"
    renderers = all_renderers()
    assert family_of(renderers["raytruth"]) is None
    assert family_of(renderers["mitsuba-llvm"]) == family_of(renderers["mitsuba"]) == "mitsuba"
