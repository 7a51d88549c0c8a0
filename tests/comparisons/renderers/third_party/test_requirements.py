from __future__ import annotations

import pickle
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.comparisons.renderers.third_party.requirements import MEMBERS, what_is_wrong
from tests.comparisons.matrix.pretending import Pretender

if TYPE_CHECKING:
    from collections.abc import Callable

pytestmark = pytest.mark.clause("REN-11")


class Without:
    """A renderer that lacks one member."""

    def __init__(self, member: str) -> None:
        self.member = member

    def __getattr__(self, name: str) -> Any:
        if name == self.member or name.startswith("__"):
            raise AttributeError(name)
        return getattr(Pretender(), name)


@dataclass
class Unmovable(Pretender):
    """One that cannot travel to another process."""

    key: Callable[[], int] = lambda: 1


@pytest.mark.parametrize("name", sorted(all_renderers()))
def test_what_obeys_the_protocol_is_taken(name: str) -> None:
    assert what_is_wrong(all_renderers()[name]) is None
    assert what_is_wrong(Pretender()) is None


@pytest.mark.parametrize("member", MEMBERS)
def test_a_member_that_is_lacking_is_named(member: str) -> None:
    assert what_is_wrong(Without(member)) == f"it lacks what the protocol Renderer asks for: {member}"


@pytest.mark.parametrize("name", ["", "../up", "a/b", "a b", "-a", "Upper", "a" * 41, "a\n", None, 3])
def test_names_that_could_not_be_paths_and_words_of_commands_are_refused(name: Any) -> None:
    assert "are expected to be of lower-case letters" in str(what_is_wrong(Pretender(name=name)))
    integrator = Integrator(name, "Ee")
    assert "are expected to be of lower-case letters" in str(what_is_wrong(Pretender(integrators=(integrator,))))


@pytest.mark.parametrize("integrators", [(), [Integrator("a", "Ee")], ("a",), None])
def test_integrators_that_are_none_are_refused(integrators: Any) -> None:
    assert "its integrators are expected" in str(what_is_wrong(Pretender(integrators=integrators)))


@pytest.mark.parametrize("model", [None, "float32"])
def test_error_models_that_are_none_are_refused(model: Any) -> None:
    assert "its error_models are expected" in str(what_is_wrong(Pretender(error_model=model)))


def test_members_that_are_no_methods_are_refused() -> None:
    renderer = Pretender()
    renderer.version = "1.0"  # type: ignore[assignment, method-assign]  # that is the mistake
    assert what_is_wrong(renderer) == "its version is expected to be a method"


def test_what_cannot_travel_to_another_process_raises() -> None:
    with pytest.raises(pickle.PicklingError, match="Unmovable"):
        what_is_wrong(Unmovable())
