"""A material's term that no exporter knows is refused by all, and nothing is derived as if it were not there."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest

from raytruth.scenes.consistency import inconsistencies, parts_of
from raytruth.scenes.exporters import cycles_limits
from raytruth.scenes.exporters.formats import FORMATS
from raytruth.scenes.features import Feature
from raytruth.scenes.hidden_lights import may_be_hidden
from raytruth.scenes.light_paths import LETTERS, comparable_depth
from raytruth.scenes.materials import Material
from raytruth.scenes.requirements import required_features
from tests.scenes.exporter_scenes import FLOOR, RED
from tests.scenes.made_up_terms import GOLDEN_GLITTER, MadeUpMaterial, made_up

if TYPE_CHECKING:
    from pathlib import Path

# json is a scene file of our own, which states whatever a scene does.
FOREIGN_FORMATS = [name for name in FORMATS if name != "json"]


@pytest.mark.clause("REN-3")
@pytest.mark.parametrize("name", FOREIGN_FORMATS)
def test_a_format_refuses_a_term_that_it_has_never_heard_of(name: str, tmp_path: Path) -> None:
    scene = made_up("glitter", known=RED)
    assert FORMATS[name].refuses(made_up(known=RED)) is None
    assert "golden glitter" in str(FORMATS[name].refuses(scene))
    with pytest.raises(ValueError, match="golden glitter"):
        FORMATS[name].write(scene, tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.clause("REN-3")
def test_obj_refuses_it_in_the_dark_too_since_it_writes_materials_and_no_lights() -> None:
    assert "golden glitter" in str(FORMATS["obj"].refuses(made_up("glitter", known=RED, lights=())))


@pytest.mark.clause("REN-3")
def test_cycles_refuses_it_as_well_although_there_is_no_such_format() -> None:
    assert cycles_limits.refuses(made_up(known=RED)) is None
    assert "golden glitter" in str(cycles_limits.refuses(made_up("glitter", known=RED)))


@pytest.mark.clause("REN-2")
def test_a_scene_file_states_it(tmp_path: Path) -> None:
    stated = json.loads(FORMATS["json"].write(made_up("glitter", known=RED), tmp_path).read_text(encoding="utf-8"))
    assert stated["materials"]["m"].keys() == {"diffuse", "glitter"}


@pytest.mark.clause("SCN-6")
@pytest.mark.parametrize(
    ("term", "dark"),
    [("glitter", {"lights": ()}), ("shimmer", {"max_depth": 0}), ("gleam", {"ambient_light": (0.0, 0.0, 0.0)})],
)
def test_a_term_requires_its_features_where_the_scene_sends_it_light(term: str, dark: dict[str, Any]) -> None:
    bright: dict[str, Any] = {"max_depth": 1, "ambient_light": (0.1, 0.1, 0.1)}
    assert GOLDEN_GLITTER in required_features(made_up(term, **bright))
    assert GOLDEN_GLITTER not in required_features(made_up(term, **bright | dark))


@pytest.mark.clause("SCN-6")
def test_a_term_that_is_lit_makes_the_scene_require_its_lights() -> None:
    assert Feature.DIRECTIONAL_LIGHTS in required_features(made_up("glitter"))
    assert Feature.DIRECTIONAL_LIGHTS not in required_features(made_up("glow"))


@pytest.mark.clause("SCN-8", "VER-8")
@pytest.mark.parametrize(("term", "path"), [("glitter", "EDL"), ("glow", "Ee"), ("gleam", "Ee"), ("shimmer", "ESe")])
def test_light_paths_lead_over_a_term_that_is_not_known(term: str, path: str) -> None:
    changes = {"background": {"color": (1.0, 1.0, 1.0)}} if term == "shimmer" else {}
    scene = made_up(term, max_depth=1, ambient_light=(0.1, 0.1, 0.1), **changes)
    all_but_this = f"(?!{path}$)E.*"
    assert f"light paths {path}," in str(comparable_depth(scene, all_but_this, has_depth=False))


@pytest.mark.clause("SCN-8")
def test_a_light_may_be_hidden_from_a_term_that_is_not_known() -> None:
    roof = FLOOR | {"vertices": ((-5.0, 9.0, -5.0), (0.0, 9.0, 5.0), (5.0, 9.0, -5.0)), "material": "roof"}
    unlit = {"mirror": {"reflectance": (0.1, 0.1, 0.1)}}
    for term, hidden in (("glitter", True), ("glow", False)):
        materials = {"m": {term: {"reflectance": (0.1, 0.1, 0.1)}}, "roof": unlit}
        assert (may_be_hidden(made_up(materials=materials, objects=[FLOOR, roof])) is not None) == hidden


@pytest.mark.clause("SCN-1")
def test_a_term_of_the_classical_equation_alone_is_refused_in_the_radiometric_convention() -> None:
    (place, sentence), *others = inconsistencies(parts_of(made_up("glitter")))
    assert (place, others) == ("materials.m.glitter", [])
    assert "expected no glitter term in the radiometric convention" in sentence
    assert not inconsistencies(parts_of(made_up("glitter", convention="whitted")))


@pytest.mark.clause("SCN-1")
def test_a_material_without_a_term_is_told_all_that_there_are() -> None:
    with pytest.raises(ValueError, match="dielectric, emission, glitter, shimmer, glow or gleam"):
        MadeUpMaterial()


@pytest.mark.clause("SCN-6")
def test_every_term_says_where_its_light_comes_from_and_whether_it_is_classical() -> None:
    terms = {
        "ambient": {"reflectance": (0.1, 0.1, 0.1)},
        "diffuse": {"reflectance": (0.1, 0.1, 0.1)},
        "specular": {"reflectance": (0.1, 0.1, 0.1), "exponent": 2.0, "model": "blinn"},
        "mirror": {"reflectance": (0.1, 0.1, 0.1)},
        "dielectric": {"index_of_refraction": 1.5},
        "emission": {"radiance": (0.1, 0.1, 0.1)},
    }
    assert terms.keys() == Material.model_fields.keys()
    for term in Material.model_validate(terms).terms().values():
        assert term.light_from in LETTERS
        assert isinstance(term.is_classical, bool)
        assert term.features() <= set(Feature)
        assert term.features()
