"""Small scenes on each of which one field of an error model decides whether a renderer's values are feasible."""

from __future__ import annotations

from typing import Any

from raytruth.scenes.scene import Scene

GREY = {"grey": {"diffuse": {"reflectance": [0.7, 0.6, 0.5]}}}
# Far enough from the origin for float32 to keep no more than a 16th.
FAR = 1e6


def large_floor() -> Scene:
    """Seen from near, so that its corners are a thousand times farther than what is hit."""
    return _lit([quad(0.0, 1000.3)])


def far_floor() -> Scene:
    """Small, and far from the origin."""
    floor = quad(0.0, 5.0)
    floor["vertices"] = [[x + FAR, y, z + FAR] for x, y, z in floor["vertices"]]
    return _lit([floor], far=FAR)


def far_sphere() -> Scene:
    """A sphere of radius 0.9 a million away from the origin, and seen from near."""
    return _lit([{"shape": "sphere", "center": [FAR - 1, 1, FAR], "radius": 0.9, "material": "grey"}], far=FAR)


def tilted_floor() -> Scene:
    """So large that Mitsuba's offset is lost to rounding, and with no coordinate that is the same everywhere."""
    corners = [(-13e3, -25e3), (27e3, -25e3), (27e3, 15e3), (-13e3, 15e3)]
    vertices = [[x, 0.31 * x - 0.17 * z, z] for x, z in corners]
    mesh = {"shape": "mesh", "vertices": vertices, "faces": [[0, 2, 1], [0, 3, 2]], "material": "grey"}
    return _lit([mesh])


def ball_as_ground() -> Scene:
    """A sphere so large that points put back on it are farther off than Mitsuba's offset."""
    return _lit([{"shape": "sphere", "center": [0, -9193.18, 0], "radius": 9193.18, "material": "grey"}])


def ball_from_afar() -> Scene:
    """A sphere of radius 1 from ten thousand away."""
    far = 1e4
    ball = {"shape": "sphere", "center": [0.1, -0.1, 0], "radius": 1.0, "material": "grey"}
    scene = _lit([ball]).model_dump(mode="json")
    scene["camera"] |= {"position": [0.3 * far, 0.2 * far, far], "look_at": [0, 0, 0], "vertical_field_of_view": 0.018}
    return Scene.model_validate(scene)


def lamp_behind_a_plate() -> Scene:
    """A plate nearer to the lamp than Mitsuba's shadow rays go."""
    return _lit([quad(0.0, 3.3), quad(9.195, 0.5)], light=[0.1, 9.2, 0.3])


def beside_a_wall(height: float) -> Scene:
    """A floor in the shadow of a wall so low that rays which start off the floor may pass over it."""
    low, high = -height / 2, 0.4
    floor = {"shape": "triangle", "vertices": [[-high, 0, high], [high, 0, high], [0, 0, -high]], "material": "grey"}
    wall = {
        "shape": "mesh",
        "vertices": [[low, 0, -high], [low, 0, high], [low, height, high], [low, height, -high]],
        "faces": [[0, 1, 2], [0, 2, 3]],
        "material": "grey",
    }
    scene = _lit([floor, wall]).model_dump(mode="json")
    scene["camera"] = {
        "projection": "orthographic",
        "position": [0.6, 1, 0.2],
        "look_at": [0, 0, 0],
        "up": [0, 0, -1],
        "view_height": height / 4,
        "width": 4,
        "height": 3,
    }
    scene["lights"] = [{"kind": "directional", "direction": [1, -1, 0.1], "irradiance": [3, 3, 3]}]
    return Scene.model_validate(scene)


def far_plane() -> Scene:
    """One that shines, seen at a sine of about 1/20,000 through a long lens: farther than POV-Ray meets anything."""
    plane = {"shape": "plane", "point": [3, 0, 7], "normal": [0, 2, 0], "material": "grey"}
    scene = _lit([plane]).model_dump(mode="json")
    scene["camera"] |= {"position": [0, 1, 0], "look_at": [0, 0, -2e4], "vertical_field_of_view": 1e-3}
    scene["materials"]["grey"] = {"emission": {"radiance": [0.7, 0.6, 0.5]}}
    return Scene.model_validate(scene)


def single_triangle() -> Scene:
    """One that no axis is parallel to."""
    vertices = [[-2.1, 0, -1.1], [2.3, 0.2, -1.3], [0.1, 0.3, 1.7]]
    return _lit([{"shape": "triangle", "vertices": vertices, "material": "grey"}])


def quad(y: float, half: float) -> dict[str, Any]:
    """A square at this height."""
    vertices = [[-half, y, -half], [half, y, -half], [half, y, half], [-half, y, half]]
    return {"shape": "mesh", "vertices": vertices, "faces": [[0, 2, 1], [0, 3, 2]], "material": "grey"}


def _lit(objects: list[dict[str, Any]], *, light: list[float] | None = None, far: float = 0.0) -> Scene:
    near = ([0.3, 2.1, 6.2], [0.1, 0.7, 0], [3.1, 5.2, 4.3])
    whole = ([far, 2, far + 6], [far, 0.7, far], [far + 3, 5, far + 4])  # float32 keeps these
    position, look_at, lamp = whole if far else near
    camera = {"projection": "perspective", "position": position, "look_at": look_at, "vertical_field_of_view": 40}
    lights = {"kind": "point", "position": light or lamp, "intensity": [50] * 3, "falloff": "inverse_square"}
    return Scene.model_validate(
        {
            "purpose": "A test.",
            "convention": "radiometric",
            "camera": {**camera, "width": 16, "height": 12},
            "lights": [lights],
            "materials": GREY,
            "objects": objects,
        }
    )
