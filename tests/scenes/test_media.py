from __future__ import annotations

import pytest

from raytruth.scenes.materials import Dielectric
from raytruth.scenes.media import index_of_medium, relative_index
from tests.scenes.exporter_scenes import build

pytestmark = pytest.mark.clause("REFR-1")

SCENE = build(
    materials={
        "m": {"dielectric": {"index_of_refraction": 1.5}},
        "bubble": {"dielectric": {"index_of_refraction": 1.2, "outside": "m"}},
    }
)


def test_empty_space_has_the_index_one_and_a_material_its_own() -> None:
    assert index_of_medium(SCENE, None) == 1.0
    assert index_of_medium(SCENE, "m") == 1.5


@pytest.mark.parametrize(("name", "ratio"), [("m", 1.5), ("bubble", 1.2 / 1.5)])
def test_a_relative_index_is_that_inside_over_that_outside(name: str, ratio: float) -> None:
    dielectric = SCENE.materials[name].dielectric
    assert isinstance(dielectric, Dielectric)
    assert relative_index(SCENE, dielectric) == ratio
