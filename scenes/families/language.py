"""Scenes that say every pair of things that the scene format can say together: rows of a covering array.

A row chooses one alternative of each kind; `allpairspy` finds few rows in which each pair of alternatives occurs that
`goes_together` allows.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations, product
from random import Random
from typing import TYPE_CHECKING, Any

from allpairspy import AllPairs

from raytruth.scenes.families.parts import build, orthographic, perspective, plane, quadrilateral, sphere, triangle

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.scenes.families.parts import Part, Point
    from raytruth.scenes.scene import Scene

    Said = tuple[str, Any]
    """A key of CHOICES and one of its alternatives."""

CLASSICAL_MATERIALS = ("ambient", "phong", "blinn", "classical glass")
SCREENS = {"screen": "xz", "upright screen": "xy", "screen beside": "yz"}
"""Emitting tiles, each with the plane of their squares."""
GLASSES = ("glass", "classical glass", "tinted glass", "nested glass")
MATERIALS = ("matt", "mirror", "lamp", *SCREENS, "glass", "tinted glass", "nested glass", *CLASSICAL_MATERIALS)
SHAPES = ("sphere", "mesh", "triangle", "plane")
CLASSICAL_LIGHTS = ("no falloff", "polynomial")
LIGHTS = ("no light", "inverse square", "directional", *CLASSICAL_LIGHTS)
CHOICES: dict[str, tuple[Any, ...]] = {
    "material": MATERIALS,
    "other material": MATERIALS,
    "light": LIGHTS,
    "other light": LIGHTS,
    "shape": SHAPES,
    "other shape": SHAPES,
    "background": ("black", "one color", "gradient"),
    "ground": ("plain", "xz", "xy", "yz"),
    "convention": ("whitted", "radiometric"),
    "projection": ("perspective", "orthographic"),
    "up": ("upright", "tilted"),
    "inside": ("in empty space", "in water"),
    "ambient light": (False, True),
    "max_depth": (0, 3),
}
PLACES: tuple[Point, Point] = ((-0.83, 0.41, 0.13), (0.79, 0.47, -0.29))
SIZES = (0.67, 0.59)
PLANE_BELOW = 0.8
"""How far below an object's place a plane passes, so that it cuts no object and lies above the ground."""


@cache
def rows() -> tuple[dict[str, Any], ...]:
    """The rows of the covering array, each an alternative for every key of CHOICES."""
    begun_rows = AllPairs(
        list(CHOICES.values()), filter_func=lambda begun: goes_together(dict(zip(CHOICES, begun, strict=False)))
    )
    found = [dict(zip(CHOICES, row, strict=True)) for row in begun_rows]
    covered = {pair for row in found for pair in combinations(row.items(), 2)}
    overlooked = (
        pair for pair in pairs() if pair not in covered
    )  # allpairspy overlooks some pairs beside forbidden ones
    return (*found, *(row for pair in overlooked if (row := _completed(dict(pair))) is not None))


def pairs() -> Iterator[tuple[Said, Said]]:
    """All pairs of alternatives of two kinds, whether they go together or not."""
    for one, other in combinations(CHOICES, 2):
        yield from product(product([one], CHOICES[one]), product([other], CHOICES[other]))


def _completed(said: dict[str, Any]) -> dict[str, Any] | None:
    """The first row that says all this; None if there is none."""
    if not goes_together(said):
        return None
    open_key = next((key for key in CHOICES if key not in said), None)
    if open_key is None:
        return {key: said[key] for key in CHOICES}
    completed = (_completed({**said, open_key: alternative}) for alternative in CHOICES[open_key])
    return next((row for row in completed if row is not None), None)


def goes_together(said: dict[str, Any]) -> bool:
    """Whether a scene may say all this, whatever else it says."""
    materials, lights, shapes = ([said.get(kind), said.get(f"other {kind}")] for kind in ("material", "light", "shape"))
    is_classical = (
        said.get("ambient light", False)
        or any(material in CLASSICAL_MATERIALS for material in materials)
        or any(light in CLASSICAL_LIGHTS for light in lights)
    )
    if said.get("convention") == "radiometric" and is_classical:
        return False
    # Glass is what a closed surface encloses; a triangle encloses nothing.
    return not any(
        material in GLASSES and shape == "triangle" for material, shape in zip(materials, shapes, strict=True)
    )


def language(parameter: float, seed: int) -> Scene:
    """Any shapes, materials, lights and views together: each stated term in full (TREE-1), and no other (ILL-8).

    The parameter is a row of the covering array, the seed draws places, colours and sizes.
    """
    row = rows()[int(parameter)]
    random = Random(f"language {int(parameter)} {seed}")

    def near(place: Point) -> Point:
        x, y, z = place
        return x + random.uniform(-0.11, 0.11), y + random.uniform(-0.11, 0.11), z + random.uniform(-0.11, 0.11)

    objects = [
        *_object(row["shape"], row["material"], near(PLACES[0]), SIZES[0]),
        *_object(row["other shape"], row["other material"], near(PLACES[1]), SIZES[1]),
        quadrilateral("ground", (-4.1, -0.7, 3.7), (4.3, -0.7, 3.9), (4.7, -0.7, -5.1), (-4.3, -0.7, -4.9)),
    ]
    stated: dict[str, Any] = {
        "max_depth": row["max_depth"],
        "convention": row["convention"],
        "background": _background(row["background"]),
        "lights": [light for name in (row["light"], row["other light"]) for light in _lights(name, random)],
        "materials": _materials(row, {part["material"] for part in objects}, random),
        "objects": objects,
    }
    if row["ambient light"]:
        stated["ambient_light"] = (0.31, 0.29, 0.37)
    return build("Two objects of any shape and material under any light and view.", _camera(row, random), **stated)


def _camera(row: dict[str, Any], random: Random) -> Part:
    position = (random.uniform(-1.3, 1.3), random.uniform(1.3, 2.1), random.uniform(4.1, 4.7))
    look_at = (0.03, 0.17, -0.09)
    stated: Part = {"up": (0.43, 0.97, 0.31)} if row["up"] == "tilted" else {}
    if row["inside"] == "in water":
        stated["inside"] = "water"
    if row["projection"] == "orthographic":
        return orthographic(position, look_at, 2.9, **stated)
    return perspective(position, look_at, 37.0, **stated)


def _background(name: str) -> Part:
    if name == "gradient":
        return {"bottom": (0.47, 0.41, 0.37), "top": (0.19, 0.31, 0.61)}
    return {"color": (0.23, 0.29, 0.41) if name == "one color" else (0.0, 0.0, 0.0)}


def _lights(name: str, random: Random) -> list[Part]:
    if name == "no light":
        return []
    if name == "directional":
        return [{"kind": "directional", "direction": (random.uniform(-0.7, 0.7), -1.0, -0.6), "irradiance": (0.9,) * 3}]
    falloffs: dict[str, Any] = {"inverse square": "inverse_square", "no falloff": "none"}
    falloff = falloffs.get(name, {"constant": 0.3, "linear": 0.11, "quadratic": 0.07})
    power = 17.0 if name == "inverse square" else 0.8
    position = (random.uniform(-2.3, 2.3), random.uniform(2.9, 3.7), random.uniform(1.1, 2.7))
    return [{"kind": "point", "position": position, "intensity": (power, 0.9 * power, 0.8 * power), "falloff": falloff}]


def _materials(row: dict[str, Any], used: set[str], random: Random) -> Part:
    """Those that the objects have, and the media around them."""

    def color(least: float = 0.2, most: float = 0.8) -> Point:
        return random.uniform(least, most), random.uniform(least, most), random.uniform(least, most)

    def tiles(plane: str) -> Part:
        size = random.uniform(0.3, 0.5)
        return {
            "checkerboard": {
                "even": color(0.5, 0.9),
                "odd": color(0.1, 0.4),
                "size": size,
                "plane": plane,
                "offset": (0.17, 0.29),
            }
        }

    def glass(index_of_refraction: float, **stated: Any) -> Part:
        return {"dielectric": {"index_of_refraction": index_of_refraction, **stated}}

    is_in_water = row["inside"] == "in water"
    outside = {"outside": "water"} if is_in_water else {}
    highlight = {"reflectance": color(), "exponent": random.uniform(3.0, 30.0)}
    known: Part = {
        "ground": {"diffuse": {"reflectance": color() if row["ground"] == "plain" else tiles(row["ground"])}},
        "water": glass(1.33, absorption=(0.05, 0.02, 0.01)),
        "matt": {"diffuse": {"reflectance": color()}},
        "mirror": {"mirror": {"reflectance": color(0.6, 0.9)}},
        "lamp": {"emission": {"radiance": color()}},
        **{name: {"emission": {"radiance": tiles(plane)}} for name, plane in SCREENS.items()},
        "ambient": {"ambient": {"reflectance": color()}, "diffuse": {"reflectance": color()}},
        "phong": {"diffuse": {"reflectance": color()}, "specular": {"model": "phong", **highlight}},
        "blinn": {"diffuse": {"reflectance": color()}, "specular": {"model": "blinn", **highlight}},
        "glass": glass(random.uniform(1.4, 1.7), **outside),
        "tinted glass": glass(1.51, absorption=color(0.1, 0.7), **outside),
        "nested glass": glass(1.71, outside="glass"),
        "classical glass": glass(1.47, reflectance=color(0.1, 0.3), transmittance=color(), **outside),
    }
    stated = used | ({"water"} if is_in_water else set())
    return {name: material for name, material in known.items() if name in stated}


def _object(shape: str, material: str, center: Point, size: float) -> list[Part]:
    """An object of this size around a point; nested glass is one object inside another, a small one under a plane."""
    if material != "nested glass":
        return [_part(shape, material, center, size)]
    inside = (
        _part("mesh", material, _under(center), 0.3) if shape == "plane" else _part(shape, material, center, 0.6 * size)
    )
    return [_part(shape, "glass", center, size), inside]


def _part(shape: str, material: str, center: Point, size: float) -> Part:
    x, y, z = center
    if shape == "sphere":
        return sphere(material, center, size)
    if shape == "triangle":
        corners = ((x - size, y - size, z + 0.2), (x + size, y - 0.7 * size, z - 0.3), (x + 0.1, y + size, z))
        return triangle(material, *corners)
    if shape == "plane":
        return plane(material, (x, y - PLANE_BELOW, z), (0.02, 1.0, -0.03))
    return _tetrahedron(material, center, size)


def _under(center: Point) -> Point:
    """Wholly inside a half space of glass, and seen by the camera."""
    return center[0], center[1] - PLANE_BELOW - 0.7, center[2]


def _tetrahedron(material: str, center: Point, size: float) -> Part:
    """A closed mesh, its normals outward."""
    x, y, z = center
    corners = ((1, 1, 1), (-1, -1, 1), (-1, 1, -1), (1, -1, -1))
    vertices = tuple((x + a * size, y + b * size, z + c * size) for a, b, c in corners)
    return {
        "shape": "mesh",
        "vertices": vertices,
        "faces": ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)),
        "material": material,
    }
