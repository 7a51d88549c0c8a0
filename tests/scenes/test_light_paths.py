from __future__ import annotations

import re
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from raytruth.scenes.library import open_scene
from raytruth.scenes.light_paths import WHITTED, _Graph, comparable_depth, whitted_class
from raytruth.scenes.lights import ConstantBackground
from tests.scenes.exporter_scenes import BALL, GLASS, LAMP, MIRROR, POINT, RED, SUN, build

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("SCN-8")

DIRECT = "E(S?e|D[Le])"
PATH = "E[DS]{{0,{depth}}}(L|e)"
LETTERS = {"red": "D", "mirror": "S", "glass": "S", "lamp": "", "coated": "SD"}
MATERIALS = {"red": RED, "mirror": MIRROR, "glass": GLASS, "lamp": LAMP, "coated": RED | MIRROR}


def ball(material: str, x: float = 0.0, radius: float = 1.0) -> dict[str, Any]:
    return {"shape": "sphere", "center": (x, 0.0, 0.0), "radius": radius, "material": material}


def triangle(material: str, *vertices: tuple[float, float, float]) -> dict[str, Any]:
    return {"shape": "triangle", "vertices": vertices, "material": material}


def floor(material: str, x: float = 0.0, y: float = -2.0) -> dict[str, Any]:
    return triangle(material, (x - 1, y, 0.0), (x + 1, y, 0.0), (x, y, 1.0))


TILTED = ((-1.0, -2.0, 0.1), (1.0, -2.3, 0.0), (0.2, -2.1, 1.4))


def scene(*objects: dict[str, Any], max_depth: int = 3, **changes: Any) -> Scene:
    used = {name: MATERIALS[name] for name in MATERIALS if name in {shape["material"] for shape in objects}}
    return build(**{"materials": used, "objects": objects, "max_depth": max_depth, "lights": [POINT]} | changes)


def direct(of: Scene) -> int | str:
    return comparable_depth(of, DIRECT, has_depth=False)


def path(of: Scene) -> int | str:
    return comparable_depth(of, PATH, has_depth=True)


def named_path(reason: int | str) -> str:
    """The path that a reason names."""
    match = re.search(r"light paths (E[SD]*[Le]),", str(reason))
    assert match is not None, reason
    return match[1]


@pytest.mark.parametrize("light", [POINT, SUN])
def test_diffuse_surfaces_under_point_lights_are_direct_light_and_paths_of_one_bounce(light: dict[str, Any]) -> None:
    lit = scene(ball("red"), ball("red", 3.0), lights=[light])
    assert direct(lit) == 0
    assert path(lit) == 1


def test_a_mirror_over_one_flat_diffuse_floor_is_paths_of_two_bounces() -> None:
    lit = scene(ball("mirror"), floor("red"), max_depth=1)
    assert path(lit) == 2
    assert named_path(direct(lit)) == "ESDL"


def test_at_twice_the_depth_the_floor_would_be_lit_by_way_of_the_mirror() -> None:
    # Whitted at depth 2 sums nothing more, since one sphere does not see itself: still two bounces.
    assert path(scene(ball("mirror"), floor("red"), max_depth=2)) == 2
    # Two mirrors: two reflections in a row need three bounces, which hold EDSDL, too.
    assert named_path(path(scene(ball("mirror"), ball("mirror", 3.0), floor("red"), max_depth=2))) in {"EDSDL", "ESSDL"}


def test_diffuse_surfaces_that_see_each_other_and_a_mirror_are_no_class_of_paths() -> None:
    reason = path(scene(ball("red"), ball("red", 3.0), ball("mirror", 6.0), max_depth=1))
    assert named_path(reason) in {"EDDL", "EDSDL", "ESDL"}
    assert "Whitted's equation" in str(reason)


@pytest.mark.parametrize(
    "changes",
    [
        {"background": {"color": (0.0, 0.1, 0.0)}},
        {"background": {"bottom": (0.0, 0.0, 0.0), "top": (0.1, 0.1, 0.1)}},
        {"objects": [ball("red"), ball("lamp", 3.0)], "materials": {"red": RED, "lamp": LAMP}},
    ],
)
def test_what_shines_lights_diffuse_surfaces_in_both_integrators_but_not_in_whitteds(changes: dict[str, Any]) -> None:
    # Even where there is no lamp besides: then depth 0 would do for the path, but the surfaces are lit.
    lit = scene(ball("red"), **changes)
    assert named_path(direct(lit)) == "EDe"
    assert named_path(path(lit)) == "EDe"


def test_a_black_background_shines_on_nothing() -> None:
    black = {"bottom": (0.0, 0.0, 0.0), "top": (0.0, 0.0, 0.0)}
    assert path(scene(ball("red"), background=black)) == 1


@pytest.mark.parametrize("max_depth", [1, 2, 5])
def test_mirrors_that_see_only_what_shines_are_paths_of_the_scenes_depth(max_depth: int) -> None:
    shining = scene(
        ball("mirror"), ball("mirror", 3.0), ball("lamp", 6.0), max_depth=max_depth, background={"color": (1.0,) * 3}
    )
    assert path(shining) == max_depth
    if max_depth == 1:
        # `direct` looks through one mirror, just as far.
        assert direct(shining) == 0
    else:
        assert named_path(direct(shining)) == "ESSe"


@pytest.mark.parametrize("reflector", ["mirror", "glass"])
def test_at_depth_zero_mirrors_and_glass_are_black(reflector: str) -> None:
    shining = scene(ball(reflector), max_depth=0, background={"color": (1.0,) * 3})
    assert path(shining) == 0
    assert named_path(direct(shining)) == "ESe"
    assert "this integrator sums" in str(direct(shining))


def test_depth_zero_with_mirrors_in_sight_of_lit_surfaces_is_direct_light() -> None:
    lit = scene(ball("mirror"), floor("red"), max_depth=0)
    assert direct(lit) == 0
    assert path(lit) == 1


def test_in_the_dark_every_integrator_is_right_with_no_bounce() -> None:
    dark = scene(ball("red"), ball("mirror", 3.0), lights=[])
    assert direct(dark) == 0
    assert path(dark) == 0


def test_a_surface_that_only_mirrors_takes_no_light_from_a_point() -> None:
    assert path(scene(ball("mirror"), ball("mirror", 3.0))) == 0


def test_ambient_light_is_seen_in_mirrors() -> None:
    grey = {"ambient": {"reflectance": (0.5, 0.5, 0.5)}}
    changes: dict[str, Any] = {"materials": {"mirror": MIRROR, "grey": grey}, "lights": [], "convention": "whitted"}
    reflected = scene(ball("mirror"), ball("grey", 3.0), max_depth=2, ambient_light=(1.0, 1.0, 1.0), **changes)
    assert comparable_depth(reflected, WHITTED, has_depth=True) == 1
    assert comparable_depth(reflected.model_copy(update={"ambient_light": (0.0,) * 3}), WHITTED, has_depth=True) == 0


ORTHOGRAPHIC = {"projection": "orthographic", "look_at": (0.0, 0.0, 0.0), "width": 4, "height": 4, "view_height": 9.0}
PERSPECTIVE = {
    "projection": "perspective", "look_at": (0.0, 0.0, -9.0), "width": 4, "height": 4, "vertical_field_of_view": 40.0
}  # fmt: skip


@pytest.mark.parametrize(
    ("camera", "is_inside"),
    [
        (PERSPECTIVE | {"position": (0.3, 0.0, 0.0)}, True),
        (PERSPECTIVE | {"position": (0.0, 0.0, 1.1)}, False),
        (PERSPECTIVE | {"position": (0.0, 0.0, 5.0)}, False),
        # The rays of an orthographic camera start all over its plane.
        (ORTHOGRAPHIC | {"position": (3.0, 0.0, 0.5), "look_at": (3.0, 0.0, 0.0)}, True),
        (ORTHOGRAPHIC | {"position": (3.0, 0.0, 1.1), "look_at": (3.0, 0.0, 0.0)}, False),
    ],
)
def test_a_sphere_sees_itself_only_from_inside(camera: dict[str, Any], *, is_inside: bool) -> None:
    around = scene(ball("mirror"), camera=camera, background={"color": (1.0,) * 3}, max_depth=4)
    assert path(around) == (4 if is_inside else 1)
    room = scene(ball("red"), camera=camera)
    assert path(room) == 1  # deeper ones hold EDDL, which one bounce does not
    assert ("EDDL" in paths_of(room, 3)) == is_inside


def test_glass_is_seen_through_from_inside() -> None:
    through = scene(ball("glass"), background={"color": (1.0,) * 3}, max_depth=4)
    assert path(through) == 4


@pytest.mark.parametrize(
    ("objects", "sees_diffuse"),
    [
        ([floor("red")], False),
        ([triangle("red", *TILTED)], False),
        ([floor("red"), floor("red", x=5.0)], False),
        ([floor("red"), floor("red", y=-3.0)], True),
        ([floor("red"), triangle("red", *TILTED)], True),
        ([floor("red"), ball("red")], True),
    ],
)
def test_triangles_of_one_plane_do_not_see_each_other(objects: list[dict[str, Any]], *, sees_diffuse: bool) -> None:
    assert ("EDDL" in paths_of(scene(*objects), 3)) == sees_diffuse
    # With a mirror, diffuse surfaces that see each other are not comparable.
    assert isinstance(path(scene(*objects, ball("mirror", 4.0), max_depth=1)), str) == sees_diffuse


def plane(material: str, normal: tuple[float, float, float], y: float = -2.0) -> dict[str, Any]:
    return {"shape": "plane", "point": (0.3, y, 0.7), "normal": normal, "material": material}


UP = (0.0, 3.0, 0.0)


@pytest.mark.parametrize(
    ("others", "sees_diffuse"),
    [
        ([], False),  # no plane sees itself
        ([plane("red", (0.0, -1.0, 0.0))], False),  # the same plane, whichever way its normal points
        ([plane("red", (0.1, -1.0, 0.0))], True),  # a plane that crosses it
        ([plane("red", UP, y=-1.0)], True),  # a parallel one
        ([floor("red")], False),  # what lies in it
        ([floor("red", y=-1.0)], True),
        ([triangle("red", *TILTED)], True),
        ([ball("red")], True),
    ],
)
@pytest.mark.parametrize("first", ["red", "mirror"])
def test_a_plane_sees_what_is_not_in_it(others: list[dict[str, Any]], first: str, *, sees_diffuse: bool) -> None:
    graph = _Graph(scene(plane(first, UP), *others))
    assert not graph.sees[0][0]
    assert any(graph.sees[0][1:]) == sees_diffuse
    assert [graph.sees[0][j] for j in range(len(others) + 1)] == [graph.sees[j][0] for j in range(len(others) + 1)]


@pytest.mark.parametrize(("y", "inside"), [(-2.0, False), (-1.0, True), (0.5, True), (3.0, False)])
def test_a_sphere_sees_itself_where_a_plane_cuts_it(y: float, *, inside: bool) -> None:
    assert _Graph(scene(ball("red"), plane("red", UP, y))).sees[0][0] == inside


def test_a_mesh_that_is_flat_does_not_see_itself_and_others_may() -> None:
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 0.0, 1.0), (0.0, 0.0, 1.0)]
    flat = {"shape": "mesh", "vertices": corners, "faces": [(0, 1, 2), (0, 2, 3)], "material": "red"}
    bent = flat | {"vertices": [*corners[:3], (0.0, 0.5, 1.0)]}
    assert "EDDL" not in paths_of(scene(flat), 3)
    assert "EDDL" in paths_of(scene(bent), 3)
    assert "EDDL" not in paths_of(scene(flat | {"faces": [(0, 1, 2)]}), 3)


def test_the_truth_class_follows_the_scenes_depth() -> None:
    pattern = whitted_class(scene(ball("red"), max_depth=2))
    for in_class, word in [
        (True, "EDL"),
        (True, "ESSe"),
        (True, "Ee"),
        (False, "ESSSe"),
        (False, "EDDL"),
        (False, "EL"),
    ]:
        assert (re.fullmatch(pattern, word) is not None) == in_class, word


def paths_of(of: Scene, longest: int) -> set[str]:
    return set(_Graph(of).paths(longest, lambda _: True))


def words(of: Scene, longest: int) -> set[str]:
    """All paths of at most so many surfaces, one chain of objects after another: slow, and simple."""
    count = len(of.objects)
    found = set()
    assert isinstance(of.background, ConstantBackground)
    shines = any(of.background.color)
    emits = [shape.material == "lamp" for shape in of.objects]
    if shines or any(emits):
        found.add("Ee")
    for length in range(1, longest + 1):
        for chain in product(range(count), repeat=length):
            if not all(visible(of, a, b) for a, b in pairwise(chain)):
                continue
            for letters in product(*(LETTERS[of.objects[i].material] for i in chain)):
                prefix = "E" + "".join(letters)
                if letters[-1] == "D" and of.lights:
                    found.add(prefix + "L")
                if shines or any(emits[j] and visible(of, chain[-1], j) for j in range(count)):
                    found.add(prefix + "e")
    return found


def visible(of: Scene, a: int, b: int) -> bool:
    """For spheres far from the camera and horizontal triangles, which are in one plane or in two."""
    first, second = of.objects[a], of.objects[b]
    if first.shape == "sphere" or second.shape == "sphere":
        return a != b or first.material == "glass"
    assert first.shape == second.shape == "triangle"
    return bool(first.vertices[0][1] != second.vertices[0][1])


@given(
    st.lists(
        st.tuples(st.sampled_from(sorted(MATERIALS)), st.sampled_from(["ball", "low", "high"])), min_size=1, max_size=3
    ),
    st.booleans(),
    st.booleans(),
)
def test_the_paths_listed_are_those_of_all_chains_of_objects_that_see_each_other(
    choices: list[tuple[str, str]],
    has_lamp: bool,
    shines: bool,
) -> None:
    objects = [
        ball(material, 10.0 * place)
        if shape == "ball"
        else floor(material, 10.0 * place, -2.0 if shape == "low" else 2.0)
        for place, (material, shape) in enumerate(choices)
    ]
    color = (1.0, 1.0, 1.0) if shines else (0.0, 0.0, 0.0)
    of = scene(*objects, lights=[POINT] if has_lamp else [], background={"color": color})
    listed = list(_Graph(of).paths(3, lambda _: True))
    assert set(listed) == words(of, 3)
    assert listed == sorted(listed, key=len)  # shortest first, so that the reason names a short one


def test_the_ball_of_other_tests_is_comparable() -> None:
    assert path(scene(BALL | {"material": "red"})) == 1


def test_the_deepest_scene_with_mirrors_and_diffuse_surfaces_is_classified_without_listing_all_words() -> None:
    # 2^64 words over S and D would never end; those that begin no path of either class are not followed.
    scene = open_scene("mirror-over-diffuse-floor")
    deep = scene.model_copy(update={"max_depth": 64, "objects": scene.objects * 2})
    assert isinstance(comparable_depth(deep, r"E[DS]{{0,{depth}}}(L|e)", has_depth=True), str)


def test_a_dark_scene_has_no_paths() -> None:
    scene = open_scene("mirror-over-diffuse-floor").model_copy(update={"lights": (), "max_depth": 64})
    assert list(_Graph(scene).paths(66, lambda _: True)) == []
