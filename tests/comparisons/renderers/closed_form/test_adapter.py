import numpy as np
import pytest

from raytruth.comparisons.records.renderings import Rays, RendererError
from raytruth.comparisons.renderers.closed_form.adapter import ClosedFormRenderer
from raytruth.comparisons.renderers.closed_form.geometry import intersect_sphere, intersect_triangle, is_unobstructed
from raytruth.comparisons.renderers.closed_form.shading import surface_radiance
from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("REN-6")

# A sphere of radius 1 around the origin, seen from (0, 0, 5): the ray along -z hits (0, 0, 1) at distance 4.
SPHERE = {"shape": "sphere", "center": (0.0, 0.0, 0.0), "radius": 1.0, "material": "m"}
TRIANGLE = {"shape": "triangle", "vertices": ((-1.0, -1.0, 1.0), (1.0, -1.0, 1.0), (0.0, 2.0, 1.0)), "material": "m"}
CAMERA = {
    "projection": "perspective",
    "position": (0.0, 0.0, 5.0),
    "look_at": (0.0, 0.0, 0.0),
    "width": 1,
    "height": 1,
    "vertical_field_of_view": 30.0,
}
DIFFUSE = {"diffuse": {"reflectance": (0.5, 0.25, 1.0)}}
EYE = (0.0, 0.0, 5.0)
AHEAD = (0.0, 0.0, -1.0)


def point_light(position, falloff="none", intensity=(1.0, 1.0, 1.0)):
    return {"kind": "point", "position": position, "intensity": intensity, "falloff": falloff}


def sun(direction, irradiance=(1.0, 1.0, 1.0)):
    return {"kind": "directional", "direction": direction, "irradiance": irradiance}


def scene_of(shape, material=DIFFUSE, lights=(), convention="whitted", **rest):
    return Scene.model_validate(
        {
            "purpose": "A test.",
            "convention": convention,
            "camera": CAMERA,
            "objects": shape if isinstance(shape, list) else [shape],
            "materials": {"m": material},
            "lights": lights,
            **rest,
        }
    )


def rays_of(origin=EYE, *directions):
    directions = np.array([directions or (AHEAD,)], dtype=float)
    directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
    return Rays(np.broadcast_to(np.array(origin, dtype=float), directions.shape), directions)


@pytest.fixture
def color(tmp_path):
    """The colour that closed_form gives along one ray."""

    def render(scene, origin=EYE, direction=AHEAD):
        rendering = ClosedFormRenderer().render(scene, "local", 0, rays_of(origin, direction), tmp_path)
        assert rendering.image.dtype == np.float32
        return rendering.image[0, 0].tolist()

    return render


@pytest.mark.parametrize("shape", [SPHERE, TRIANGLE])
@pytest.mark.parametrize(
    ("falloff", "attenuation"),
    [
        ("none", 1),
        ("inverse_square", 1 / 4),
        ({"constant": 1.0, "linear": 0.5, "quadratic": 0.5}, 1 / 4),
        ({"constant": 0.0, "linear": 0.0, "quadratic": 0.125}, 1),  # 1/(1/2), clamped
    ],
)
def test_a_light_two_units_above_the_hit_point_gives_the_attenuated_reflectance(color, shape, falloff, attenuation):
    lights = [point_light((0.0, 0.0, 3.0), falloff, (1.0, 2.0, 4.0))]
    expected = attenuation * np.array([0.5, 0.5, 4.0])
    assert color(scene_of(shape, lights=lights)) == expected.tolist()
    radiometric = scene_of(shape, lights=lights, convention="radiometric")
    assert color(radiometric) == (expected / np.pi).astype(np.float32).tolist()


@pytest.mark.parametrize("shape", [SPHERE, TRIANGLE])
def test_a_directional_light_at_60_degrees_gives_half_its_irradiance(color, shape):
    slanted = sun((np.sqrt(3.0), 0.0, -1.0), (2.0, 2.0, 2.0))
    np.testing.assert_array_max_ulp(np.float32(color(scene_of(shape, lights=[slanted]))), np.float32([0.5, 0.25, 1.0]))


@pytest.mark.parametrize(("model", "angle"), [("phong", 60), ("blinn", 30)])
@pytest.mark.parametrize("shape", [SPHERE, TRIANGLE])
@pytest.mark.parametrize("convention", ["whitted", "radiometric"])
def test_phong_measures_from_the_mirror_direction_and_blinn_from_the_bisector(color, shape, model, angle, convention):
    # The viewer looks along the normal, the light stands at 60°: (r·v) = cos 60°, (n·h) = cos 30°. No π in either.
    material = {"specular": {"reflectance": (0.5, 1.0, 2.0), "exponent": 4.0, "model": model}}
    scene = scene_of(shape, material, [sun((np.sqrt(3.0), 0.0, -1.0))], convention)
    expected = np.cos(np.radians(angle)) ** 4 * np.float32([0.5, 1.0, 2.0])
    np.testing.assert_array_max_ulp(np.float32(color(scene)), expected.astype(np.float32))


@pytest.mark.parametrize("model", ["phong", "blinn"])
def test_there_is_no_highlight_where_the_light_is_behind_the_surface(color, model):
    material = {"specular": {"reflectance": (1.0, 1.0, 1.0), "exponent": 1e-3, "model": model}}
    behind = point_light((9.0, 0.0, 0.99))
    assert color(scene_of(TRIANGLE, material, [behind])) == [0, 0, 0]
    assert color(scene_of(SPHERE, material, [behind])) == [0, 0, 0]


def test_ambient_and_emission_need_no_light_and_add_up(color):
    material = {"ambient": {"reflectance": (0.5, 0.5, 0.5)}, "emission": {"radiance": (1.0, 2.0, 3.0)}}
    assert color(scene_of(SPHERE, material, ambient_light=(0.5, 1.0, 2.0))) == [1.25, 2.5, 4]


@pytest.mark.parametrize("plane", ["xy", "xz", "yz"])
def test_a_checkerboard_has_its_squares_in_the_plane_of_its_two_axes(color, plane):
    board = {"even": (1.0, 1.0, 1.0), "odd": (0.0, 0.0, 0.0), "size": 0.5, "plane": plane, "offset": (0.25, 0.25)}
    scene = scene_of(TRIANGLE, {"emission": {"radiance": {"checkerboard": board}}})
    # Squares begin at 0.25, so 0.5 is in the middle of number 0; the triangle lies in z = 1, that is in number 1.
    for x, column in ((-0.5, -2), (0.0, -1), (0.5, 0)):
        for y, row in ((-0.5, -2), (0.0, -1)):
            squares = {"x": column, "y": row, "z": 1}
            is_even = sum(squares[axis] for axis in plane) % 2 == 0
            assert color(scene, (x, y, 5.0)) == [float(is_even)] * 3


@pytest.mark.parametrize(
    ("eye", "light", "is_lit"),
    [
        (EYE, (0.0, 0.0, 9.0), True),  # both outside
        (EYE, (0.0, 0.0, -9.0), False),  # behind
        (EYE, (0.0, 0.0, 0.5), False),  # the light inside, seen from outside
        (EYE, (0.0, 0.0, 1.0), False),  # in the hit point itself
        ((0.0, 0.0, 0.5), (0.0, 0.0, 0.25), True),  # both inside
        ((0.0, 0.0, 0.5), (0.0, 0.0, 9.0), False),  # the light outside: the sphere hides it
        ((0.0, 0.0, 0.5), (0.0, 0.0, -9.0), False),  # outside and behind the wall that is seen
        ((0.0, 0.0, 0.5), (0.0, 0.0, 1.0), True),  # on the sphere, opposite to the wall that is seen
    ],
)
def test_a_sphere_shadows_itself(color, eye, light, is_lit):
    assert color(scene_of(SPHERE, lights=[point_light(light)]), eye) == ([0.5, 0.25, 1.0] if is_lit else [0, 0, 0])


def test_the_sun_does_not_shine_into_a_sphere(color):
    assert color(scene_of(SPHERE, lights=[sun((0.0, 0.0, -1.0))]), (0.0, 0.0, 0.5)) == [0, 0, 0]


@pytest.mark.parametrize("side", [1, -1])
def test_a_triangle_is_shaded_on_the_side_of_the_viewer(color, side):
    eye, ahead = (0.0, 0.0, 1.0 + 4 * side), (0.0, 0.0, -side)
    assert color(scene_of(TRIANGLE, lights=[point_light((0.0, 0.0, 1.0 + side))]), eye, ahead) == [0.5, 0.25, 1.0]
    assert color(scene_of(TRIANGLE, lights=[point_light((0.0, 0.0, 1.0 - side))]), eye, ahead) == [0, 0, 0]


def test_a_ray_that_misses_sees_the_background(color):
    gradient = {"bottom": (0.0, 1.0, 2.0), "top": (1.0, 1.0, 0.0)}
    for direction, expected in (((0, 1, 0), (1, 1, 0)), ((0, -1, 0), (0, 1, 2)), ((1, 0, 0), (0.5, 1, 1))):
        assert color(scene_of(SPHERE, background=gradient), direction=direction) == list(expected)
    assert color(scene_of(SPHERE, background={"color": (1.0, 2.0, 3.0)}), direction=(1, 0, 0)) == [1, 2, 3]


def test_the_images_of_single_lights_add_up_to_the_image_of_all(color):
    lights = [point_light((0.0, 3.0, 3.0)), sun((1.0, 0.0, -2.0)), point_light((1.0, 0.0, 4.0), "inverse_square")]
    apart = np.sum([color(scene_of(SPHERE, lights=[light])) for light in lights], axis=0)
    np.testing.assert_array_max_ulp(np.float32(color(scene_of(SPHERE, lights=lights))), apart.astype(np.float32), 4)


def test_a_mesh_of_one_face_is_a_triangle(color):
    vertices = [(7.0, 7.0, 7.0), *TRIANGLE["vertices"]]
    mesh = {"shape": "mesh", "vertices": vertices, "faces": ((1, 2, 3),), "material": "m"}
    lights = [point_light((1.0, 2.0, 3.0))]
    assert color(scene_of(mesh, lights=lights)) == color(scene_of(TRIANGLE, lights=lights))


@pytest.mark.parametrize(
    ("scene", "reason"),
    [
        (scene_of([SPHERE, TRIANGLE]), "2 primitives"),
        (scene_of(SPHERE, {"mirror": {"reflectance": (1.0, 1.0, 1.0)}}), "reflects or refracts"),
        (scene_of(SPHERE, {"dielectric": {"index_of_refraction": 1.5}}), "reflects or refracts"),
        (scene_of(SPHERE, camera={**CAMERA, "inside": "m"}), "camera is inside"),
    ],
)
def test_what_has_no_closed_form_is_refused_with_the_reason(scene, reason, tmp_path):
    assert reason in ClosedFormRenderer().refuses(scene)
    with pytest.raises(RendererError, match=reason):
        ClosedFormRenderer().render(scene, "local", 0, rays_of(), tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_first_hits_are_the_shapes_own_geometry(tmp_path):
    scene = scene_of(SPHERE, lights=[point_light((0.0, 0.0, 9.0))])
    renderer = ClosedFormRenderer()
    outside = renderer.render(scene, "local", 0, rays_of(EYE, AHEAD, (0, 1, 0)), tmp_path).first_hits
    assert outside.depth.tolist() == [[4, np.inf]]
    assert outside.primitive.tolist() == [[0, -1]]
    assert outside.position[0, 0].tolist() == outside.normal[0, 0].tolist() == [0, 0, 1]
    inside = renderer.render(scene, "local", 0, rays_of((0, 0, 0), (0, 1, 0)), tmp_path).first_hits
    assert inside.normal[0, 0].tolist() == [0, 1, 0]
    assert "NumPy" in (tmp_path / "log.txt").read_text()


@pytest.mark.parametrize("shape", [SPHERE, TRIANGLE])
@pytest.mark.parametrize("model", ["phong", "blinn"])
def test_float64_keeps_the_declared_bits_against_extended_precision(shape, model, tmp_path):
    rng = np.random.default_rng(7)
    exponent = 8.0
    material = {**DIFFUSE, "specular": {"reflectance": (1.0, 1.0, 1.0), "exponent": exponent, "model": model}}
    lights = [point_light((2.1, 3.7, 4.9), "inverse_square", (9.0, 9.0, 9.0)), sun((0.3, -0.2, -1.1))]
    scene = scene_of(shape, material, lights)
    # Within 1/8 of the axis no ray grazes the sphere or leaves the triangle: conditions are below 4, or the exponent.
    aims = rng.uniform(-0.1, 0.1, (1000, 2))
    rays = rays_of(EYE, *[(x, y, -1.0) for x, y in aims])
    extended = Rays(rays.origins.astype(np.longdouble), rays.directions.astype(np.longdouble))
    renderer = ClosedFormRenderer()
    exact = radiance_of(scene, extended)
    assert exact.dtype == np.longdouble
    roundoff = 2.0**-renderer.error_model.precision_bits
    assert np.all(abs(radiance_of(scene, rays) - exact) <= 4 * roundoff * exact)
    image = renderer.render(scene, "local", 0, rays, tmp_path).image
    assert np.all(abs(image - exact) <= 2.0**-24 * exact + 4 * roundoff * exact)


def radiance_of(scene, rays):
    (shape,) = scene.objects
    if shape.shape == "sphere":
        hits = intersect_sphere(rays, np.array(shape.center), shape.radius)
    else:
        hits = intersect_triangle(rays, np.array(shape.vertices))
    assert hits.is_hit.all()
    free = [is_unobstructed(light, shape, hits) for light in scene.lights]
    return surface_radiance(scene, scene.materials["m"], hits, rays.directions, free)
