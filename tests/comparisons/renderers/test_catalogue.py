import pytest

from raytruth.comparisons.renderers.catalogue import UnknownRendererError, all_renderers, select_renderers

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
