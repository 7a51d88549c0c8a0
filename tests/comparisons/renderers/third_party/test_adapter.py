from __future__ import annotations

import inspect
import pickle
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.comparisons.matrix.cell_key import adapter_digest
from raytruth.comparisons.renderers.protocol import GivenRenderer, command_of
from raytruth.comparisons.renderers.third_party import adapter
from raytruth.comparisons.renderers.third_party.adapter import ThirdPartyRenderer
from raytruth.comparisons.renderers.third_party.requirements import MEMBERS
from raytruth.scenes.library import open_scene
from tests.comparisons.matrix.pretending import Pretender

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-11")


class Echo(Pretender):
    """Renders what it is given."""

    def render(self, *given: Any) -> Any:
        return given


def test_all_that_it_says_and_does_is_what_the_packages_renderer_says_and_does(tmp_path: Path) -> None:
    own = Echo(name="echo", refusal="it is tired")
    renderer = ThirdPartyRenderer(own, "some-package 1.0")
    scene: Scene = open_scene("glass-sphere")
    rays: Any = "rays"
    assert isinstance(renderer, GivenRenderer)
    for member in MEMBERS:
        if not callable(getattr(own, member)):
            assert getattr(renderer, member) == getattr(own, member)
    assert renderer.version() == own.version()
    assert renderer.refuses(scene) == "it is tired"
    assert renderer.is_stochastic(scene, "whitted") is True
    assert renderer.render(scene, "whitted", 3, rays, tmp_path) == (scene, "whitted", 3, rays, tmp_path)
    assert pickle.loads(pickle.dumps(renderer)) == renderer


def test_a_cell_is_repeated_by_its_name() -> None:
    command = command_of(ThirdPartyRenderer(Pretender(), "some-package 1.0"), "my scene.json")
    assert command == "raytruth run 'my scene.json' --renderer pretender --fresh"


@pytest.mark.clause("RES-3")
def test_another_version_of_the_package_or_another_file_of_the_class_makes_other_cells(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    renderers = [ThirdPartyRenderer(Pretender(), f"strange-package {version}") for version in ("1.0", "1.1", "1.0")]
    first, other, same = map(adapter_digest, renderers)
    assert first == same != other
    edited = tmp_path / "edited.py"
    edited.write_text(Path(inspect.getfile(Pretender)).read_text(encoding="utf-8") + "\n", encoding="utf-8")
    monkeypatch.setattr(adapter.inspect, "getfile", lambda _: str(edited))
    assert ThirdPartyRenderer(Pretender(), "strange-package 1.0").digest != renderers[0].digest
