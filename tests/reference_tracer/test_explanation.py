import math

import pytest

from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.explanation import MOST_RAYS, ExplanationError, explain
from raytruth.reference_tracer.explanation_record import Explanation
from raytruth.reference_tracer.rendering import prepare
from raytruth.scenes.library import open_scene
from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-7")

# Together they have every term, both projections, both kinds of lights, absorption, and meshes in a tree of boxes.
SCENES = (
    "whitted-1980",
    "tinted-glass",
    "constant-weight-glass",
    "total-reflection-prism",
    "directional-phong",
    "blinn-sphere",
    "self-shadowing-ring",
    "parallel-projection",
    "mirror-room-of-planes",
    "half-space-of-water",
)


def pixel_of(scene: Scene, x: int, y: int) -> object:
    prepared = prepare(scene, FLOAT)
    return prepared.kernel.radiance_at(prepared.data, prepared.kernel.camera_frame(prepared.data), x + 0.5, y + 0.5)


def with_camera(scene: Scene, **changes: object) -> Scene:
    return scene.model_copy(update={"camera": scene.camera.model_copy(update=changes)})


def explained(name: str) -> Explanation:
    scene = open_scene(name)
    return explain(scene, scene.camera.width // 2, scene.camera.height // 2)


@pytest.mark.parametrize("name", SCENES)
def test_the_sum_is_bit_for_bit_the_tracers_pixel(name: str) -> None:
    scene = open_scene(name)
    x, y = scene.camera.width * 2 // 5, scene.camera.height * 3 // 5
    assert explain(scene, x, y).sum == pixel_of(scene, x, y)


@pytest.mark.parametrize("name", ["whitted-1980", "tinted-glass", "directional-phong"])
def test_every_contribution_is_weight_times_what_is_seen(name: str) -> None:
    tree = explained(name)
    assert len(tree.rays) == 1 or tree.rays[0].dielectric or tree.rays[0].mirror_reflectance
    total = (0.0, 0.0, 0.0)
    for ray in tree.rays:
        seen = ray.background if ray.hit is None else ray.local
        through = ray.medium_transmittance or (1.0, 1.0, 1.0)
        assert seen is not None
        assert ray.contribution == tuple(w * t * s for w, t, s in zip(ray.weight, through, seen, strict=True))
        total = tuple(a + b for a, b in zip(total, ray.contribution, strict=True))
    assert total == tree.sum


def test_rays_form_a_tree_whose_depth_falls_by_one_at_each_level() -> None:
    tree = explained("glass-sphere")
    assert [ray.number for ray in tree.rays] == list(range(len(tree.rays)))
    assert tree.rays[0].parent is None
    assert tree.rays[0].kind == "camera"
    for ray in tree.rays[1:]:
        assert ray.parent is not None
        parent = tree.rays[ray.parent]
        assert parent.number < ray.number
        assert parent.hit is not None
        assert ray.depth_left == parent.depth_left - 1
        assert ray.origin == parent.hit.point
        assert ray.starts_on == parent.hit.primitive


def test_a_transmitted_ray_is_in_the_glass_and_has_the_weight_of_the_split() -> None:
    tree = explained("glass-sphere")
    term = tree.rays[0].dielectric
    assert term is not None
    transmitted = next(ray for ray in tree.rays if ray.parent == 0 and ray.kind == "transmitted")
    reflected = next(ray for ray in tree.rays if ray.parent == 0 and ray.kind == "reflected")
    assert tree.rays[0].hit is not None
    assert transmitted.medium == tree.rays[0].hit.material
    assert reflected.medium is None
    assert transmitted.weight == term.transmitted_weight
    assert reflected.weight == term.reflected_weight
    assert term.fresnel_reflectance == term.reflected_weight[0]


def test_total_internal_reflection_sends_one_ray_on() -> None:
    tree = explained("total-reflection-prism")
    totals = [ray for ray in tree.rays if ray.dielectric and ray.dielectric.total_internal_reflection]
    assert totals
    for ray in totals:
        assert ray.dielectric is not None
        assert ray.dielectric.discriminant < 0
        assert ray.dielectric.transmitted_weight is None
        assert [child.kind for child in tree.rays if child.parent == ray.number] in (["reflected"], [])


@pytest.mark.parametrize(
    ("name", "x", "y", "shape"), [("sphere-over-floor", 66, 43, "sphere"), ("cornell-box", 22, 58, "mesh")]
)
def test_a_shadow_names_the_primitive_and_the_object_in_the_way(name: str, x: int, y: int, shape: str) -> None:
    scene = open_scene(name)
    tree = explain(scene, x, y)
    term = next(term for term in tree.rays[0].lights if term.shadowed)
    assert tree.rays[0].hit is not None
    assert term.occluder is not None
    assert term.occluder_object is not None
    assert term.occluder != tree.rays[0].hit.primitive
    assert scene.objects[term.occluder_object].shape == shape
    assert term.radiance == (0, 0, 0)


def test_a_wall_that_hides_a_lamp_is_named_among_planes_too() -> None:
    # The floor, object 1, is seen where the lamp behind the wall, object 2, would light it; after one sphere.
    tree = explain(open_scene("mirror-room-of-planes"), 70, 60)
    assert tree.rays[0].hit is not None
    assert tree.rays[0].hit.primitive == 1
    assert (tree.rays[0].lights[1].occluder, tree.rays[0].lights[1].occluder_object) == (2, 2)


def test_lights_keep_their_numbers_whatever_their_kinds() -> None:
    scene = open_scene("several-lights-sphere")
    terms = explained("several-lights-sphere").rays[0].lights
    assert len(terms) == len(scene.lights)
    for term in terms:
        light = scene.lights[term.light]
        assert term.kind == light.kind
        assert (term.attenuation is None) == (light.kind == "directional")


def test_a_light_behind_the_surface_is_not_asked_for_shadow() -> None:
    scene = open_scene("light-behind")
    terms = [
        term
        for x in range(8, scene.camera.width, 16)
        for term in explain(scene, x, scene.camera.height // 2).rays[0].lights
    ]
    behind = [term for term in terms if term.cosine <= 0]
    assert behind
    assert all(term.shadowed is None and term.radiance == (0, 0, 0) for term in behind)


def test_an_explanation_survives_json_exactly() -> None:
    tree = explained("whitted-1980")
    assert Explanation.model_validate_json(tree.model_dump_json()) == tree


@pytest.mark.parametrize(("x", "y"), [(-1, 0), (0, -1), (64, 0), (0, 64)])
def test_a_pixel_outside_the_image_is_refused(x: int, y: int) -> None:
    with pytest.raises(ExplanationError, match="outside the image"):
        explain(open_scene("glass-sphere"), x, y)


def test_a_tree_too_large_to_read_is_refused() -> None:
    scene = open_scene("bubble-in-glass").model_copy(update={"max_depth": 64})
    with pytest.raises(ExplanationError, match=f"more than {MOST_RAYS} rays"):
        explain(scene, scene.camera.width // 2, scene.camera.height // 2)


@pytest.mark.clause("ILL-9")
def test_a_light_at_the_very_point_that_is_seen_adds_nothing() -> None:
    scene = open_scene("single-sphere")
    tree = explained("single-sphere")
    assert tree.rays[0].hit is not None
    light = scene.lights[0].model_copy(update={"position": tree.rays[0].hit.point, "falloff": "inverse_square"})
    (term,) = explain(scene.model_copy(update={"lights": (light,)}), tree.x, tree.y).rays[0].lights
    assert term.attenuation == math.inf
    assert math.isnan(term.cosine)
    assert term.radiance == (0.0, 0.0, 0.0)
