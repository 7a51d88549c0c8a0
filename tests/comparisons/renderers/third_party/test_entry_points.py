from __future__ import annotations

import os
from pathlib import Path

import pytest

from raytruth.comparisons.renderers import catalogue
from raytruth.comparisons.renderers.third_party import entry_points
from raytruth.comparisons.renderers.third_party.adapter import ThirdPartyRenderer
from raytruth.comparisons.renderers.third_party.entry_points import GROUP, ThirdParty, third_party
from tests.comparisons.matrix.pretending import Pretender
from tests.comparisons.renderers.third_party.installed import pretend_installed

pytestmark = pytest.mark.clause("REN-11")

ROOT = Path(__file__).parents[4]
EXAMPLE = ROOT / "examples" / "adapter-package" / "src"

MODULE = """
import os, signal, sys, time
from raytruth_flat import Flat

class Lacking:
    name = "lacking"

def hangs():
    time.sleep(1000)

def falls():
    os.kill(os.getpid(), signal.SIGSEGV)

def raises():
    raise SystemError("no such thing")

def named(name):
    def make():
        renderer = Flat()
        renderer.name = name
        return renderer
    return make

taken = named("taken")
ours = named("povray")
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder on the path, of this process and of those that it starts."""
    places = [str(tmp_path), str(EXAMPLE)]
    for place in places:
        monkeypatch.syspath_prepend(place)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([*places, str(ROOT)]))
    third_party.cache_clear()
    return tmp_path


def test_the_renderers_of_an_installed_package_are_taken_with_its_version(folder: Path) -> None:
    pretend_installed(folder, "raytruth-flat", "1.2", GROUP, {"flat": "raytruth_flat:Flat"})
    found = third_party(frozenset({"povray"}))
    assert {name: renderer.origin for name, renderer in found.renderers.items()} == {"flat": "raytruth-flat 1.2"}
    assert found.problems == ()


def test_an_adapter_that_hangs_is_left_out(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(entry_points, "TRIAL_SECONDS", 1.0)
    (folder / "odd_adapters.py").write_text(MODULE, encoding="utf-8")
    pretend_installed(folder, "odd-adapters", "0.1", GROUP, {"hangs": "odd_adapters:hangs"})
    (told,) = third_party(frozenset()).problems
    assert "1 s" in told


def test_whatever_is_wrong_with_an_adapter_is_a_sentence_and_the_others_are_taken(folder: Path) -> None:
    (folder / "odd_adapters.py").write_text(MODULE, encoding="utf-8")
    (folder / "broken_adapter.py").write_text("import nothing_of_this_name", encoding="utf-8")
    points = {
        "broken": "broken_adapter:make",
        "falls": "odd_adapters:falls",
        "good": "odd_adapters:Flat",
        "lacking": "odd_adapters:Lacking",
        "missing": "odd_adapters:missing",
        "ours": "odd_adapters:ours",
        "raises": "odd_adapters:raises",
    }
    pretend_installed(folder, "odd-adapters", "0.1", GROUP, points)
    pretend_installed(folder, "other-adapters", "0.2", GROUP, {"again": "odd_adapters:Flat"})
    found = third_party(frozenset({"povray"}))
    assert {name: renderer.origin for name, renderer in found.renderers.items()} == {"flat": "odd-adapters 0.1"}
    told = {sentence.split("'")[1]: sentence for sentence in found.problems}
    causes = {
        "again": "the name flat is that of a renderer of the package odd-adapters 0.1",
        "broken": "ModuleNotFoundError: No module named 'nothing_of_this_name'",
        "falls": "was ended by signal SIGSEGV",
        "lacking": "it lacks what the protocol Renderer asks for: integrators",
        "missing": "AttributeError",
        "ours": "the name povray is that of one of raytruth's own renderers",
        "raises": "SystemError: no such thing",
    }
    assert told.keys() == causes.keys()
    for name, cause in causes.items():
        assert cause in told[name]
        assert told[name].startswith(f"The renderer '{name}' of the package o")
        assert "\n" not in told[name]
        assert "Traceback" not in told[name]


def test_the_catalogue_holds_them_beside_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    stranger = ThirdPartyRenderer(Pretender(name="stranger"), "x 1")
    monkeypatch.setattr(catalogue, "third_party", lambda _: ThirdParty({"stranger": stranger}, ("One is broken.",)))
    assert catalogue.all_renderers()["stranger"] is stranger
    assert "povray" in catalogue.all_renderers()
    assert catalogue.unusable_adapters() == ("One is broken.",)
