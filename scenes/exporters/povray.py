"""Writes a scene as a scene file of POV-Ray 3.7 that a person can read and render there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.scenes.exporters.povray_limits import DEEPEST, FARTHEST, refuses, unit_of
from raytruth.scenes.exporters.povray_materials import declare_material, fading, interior_of, polynomial_falloff
from raytruth.scenes.exporters.povray_text import block, color, comment, vector
from raytruth.scenes.extent import spans_of
from raytruth.scenes.lights import ConstantBackground, PointLight
from raytruth.scenes.planes import has_planes
from raytruth.scenes.shapes import Mesh, Plane, Sphere

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.lights import Light
    from raytruth.scenes.materials import Dielectric
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape

SCENE_FILE = "scene.pov"
# POV-Ray's rays meet no sphere this small (in its units: half a chord must exceed 1e-5), but a point can be inside it.
HOLE_RADIUS = 5e-6
# A parallel light of POV-Ray throws no shadows of what is behind its position: in radii of a ball around all objects.
SUN_DISTANCE = 2.0
# Infinite planes are in no ball. But each ray of a path meets what is within FARTHEST, the shadow ray at its end, too;
# there are the camera's ray, as many as bounces, and one shadow ray. One more is left for the size of all else.
SUN_DISTANCE_OVER_PLANES = (DEEPEST + 3) * FARTHEST

HEADER = """\
#version 3.7;
// POV-Ray ignores what is nearer than 0.0001 to where a ray starts, and shadows of what is nearer than 0.001.
// So all lengths are multiplied by this.
#declare unit = {unit};
// All that shines is multiplied by this; a smaller one keeps bright pictures from being clipped.
#declare exposure = {exposure!r};
// The weight of all but the first term in a material: see below.
#declare faint = pow(2, -30);
"""


def export_povray(scene: Scene, folder: Path, *, exposure: float = 1.0, file_name: str = SCENE_FILE) -> Path:
    """Write `scene` to `folder` and return the path of the file.

    All that shines is multiplied by `exposure`, and so is the picture. Raises ValueError where `refuses(scene)`,
    OSError if it cannot be written.
    """
    reason = refuses(scene)
    if reason:
        raise ValueError(f"scene {scene.name!r} cannot be written for POV-Ray, because {reason}")
    identifiers = {name: f"material_{number}" for number, name in enumerate(_used_materials(scene))}
    parts = [
        comment(f"{scene.name or 'scene'}: {scene.purpose}"),
        comment(f"povray {file_name} {' '.join(options_of(scene))}"),
        HEADER.format(unit=unit_of(scene), exposure=exposure),
        _settings(scene),
        _camera(scene),
        _background(scene),
        *(_light(scene, light) for light in scene.lights),
        *(declare_material(scene, short, name, scene.materials[name]) for name, short in identifiers.items()),
        *(_object(scene, shape, identifiers[shape.material]) for shape in scene.objects),
    ]
    path = folder / file_name
    path.write_text("\n".join(part for part in parts if part), encoding="utf-8")
    return path


def options_of(scene: Scene) -> tuple[str, ...]:
    """What POV-Ray must be told on its command line: one ray through each pixel's centre, linear 16-bit numbers."""
    size = (f"+W{scene.camera.width}", f"+H{scene.camera.height}")
    return (*size, "+FN16", "File_Gamma=1.0", "Dither=off", "-A", "-J", "-D", "-P", "-UA", "+Q9")


def _used_materials(scene: Scene) -> list[str]:
    return list(dict.fromkeys(shape.material for shape in scene.objects))


def _settings(scene: Scene) -> str:
    levels = scene.max_depth + 1  # the camera's ray is the first
    return "\n".join(
        (
            block(
                "global_settings",
                "assumed_gamma 1",
                f"max_trace_level {levels}",
                "adc_bailout 0",
                f"ambient_light {color(scene.ambient_light)}*exposure",
            ),
            "#default { pigment { rgb 0 } finish { ambient 0 diffuse 0 } }\n",
        )
    )


def _camera(scene: Scene) -> str:
    """By its vectors alone: `right` decides which way the axes are handed, so that no coordinate changes its sign."""
    camera = scene.camera
    if camera.projection == "perspective":
        height = f"2*tan(radians({camera.vertical_field_of_view!r}/2))"
    else:
        height = f"{camera.view_height!r}*unit"
    return "\n".join(
        (
            f"#declare position = {vector(camera.position)};",
            f"#declare forward = vnormalize({vector(camera.look_at)} - position);",
            f"#declare rightward = vnormalize(vcross(forward, {vector(camera.up)}));",
            f"#declare visible_height = {height};",
            block(
                "camera",
                camera.projection,
                "location position*unit",
                "direction forward",
                f"right rightward*visible_height*{camera.width}/{camera.height}",
                "up vcross(rightward, forward)*visible_height",
            )
            + "\n",
        )
    )


def _background(scene: Scene) -> str:
    background = scene.background
    if isinstance(background, ConstantBackground):
        return f"background {{ {color(background.color)}*exposure }}\n"
    # The gradient counts from 0 to 1 and then again from 0: y from -1 to 1 becomes 1/4 to 3/4.
    ends = f"[0.25 {color(background.bottom)}*exposure] [0.75 {color(background.top)}*exposure]"
    return f"sky_sphere {{ pigment {{ gradient y color_map {{ {ends} }} scale 4 translate -2*y }} }}\n"


def _light(scene: Scene, light: Light) -> str:
    if isinstance(light, PointLight):
        lines = [f"{vector(light.position)}*unit, {color(light.intensity)}*exposure"]
        fades = fading(light.falloff)
        if fades:
            factor, distance = fades
            lines = [f"{vector(light.position)}*unit, {color(light.intensity)}*exposure*{factor!r}"]
            lines.append(f"fade_distance {distance!r}*unit fade_power 2")
        elif polynomial_falloff(light):
            lines.append("// its attenuation is in the textures that it lights")
        return block("light_source", *lines) + "\n"
    centers, radii = spans_of(scene)
    middle = centers.mean(axis=0)
    radius = float((np.linalg.norm(centers - middle, axis=1) + radii).max())
    far = SUN_DISTANCE_OVER_PLANES / unit_of(scene) if has_planes(scene) else SUN_DISTANCE * radius
    position = middle - far * np.array(light.direction) / np.linalg.norm(light.direction)
    # What the light looks at is as far as it is, where it is so far that rounding its place would turn it else.
    point_at = vector(middle) if has_planes(scene) else f"({vector(position)} + {vector(light.direction)})"
    lines = [f"{vector(position)}*unit, {color(light.irradiance)}*exposure", "parallel"]
    lines.append(f"point_at {point_at}*unit")
    return block("light_source", *lines) + "\n"


def _object(scene: Scene, shape: Shape, identifier: str) -> str:
    dielectric = scene.materials[shape.material].dielectric
    if dielectric is None or scene.max_depth == 0:
        return _shape(_facing_camera(scene, shape), f"texture {{ {identifier} }}") + "\n"
    glass = _glass(scene, shape, identifier, dielectric)
    return f"{glass}\n// Every surface throws a black shadow: this one does nothing else.\n{_shadow(scene, shape)}\n"


def _facing_camera(scene: Scene, shape: Shape) -> Shape:
    """An opaque plane, which looks alike from both sides, with its normal on that of the camera and so of all rays.

    The other side is inside of it for POV-Ray, and a camera that is inside of an object is in its medium.
    """
    if isinstance(shape, Plane) and np.subtract(scene.camera.position, shape.point) @ np.array(shape.normal) < 0.0:
        x, y, z = shape.normal
        return shape.model_copy(update={"normal": (-x, -y, -z)})
    return shape


def _glass(scene: Scene, shape: Shape, identifier: str, dielectric: Dielectric) -> str:
    textures = f"texture {{ {identifier} }} interior_texture {{ {identifier}_inside }}"
    last = (textures, interior_of(dielectric), "hollow no_shadow")
    holds_camera = scene.camera.inside == shape.material and not isinstance(shape, Sphere | Plane)
    # Triangles have no inside. A sphere that no ray can see tells that the camera is inside of what they enclose.
    inside = "sphere { position*unit, 1 no_image no_reflection no_shadow }"
    return _shape(shape, *last, also=inside if holds_camera else "")


def _shadow(scene: Scene, shape: Shape) -> str:
    shadow = "no_image no_reflection"
    if isinstance(shape, Sphere | Plane) and scene.camera.inside == shape.material:
        # With a hole around the camera, which would be inside of two objects else.
        return block("difference", _shape(shape), f"sphere {{ position*unit, {HOLE_RADIUS!r} }}", shadow)
    return _shape(shape, shadow)


def _shape(shape: Shape, *last: str, also: str = "") -> str:
    if isinstance(shape, Sphere):
        return block("sphere", f"{vector(shape.center)}*unit, {shape.radius!r}*unit", *last)
    if isinstance(shape, Plane):
        # Its place is how far it is from the origin along the unit normal.
        normal = f"vnormalize({vector(shape.normal)})"
        return block("plane", f"{normal}, vdot({vector(shape.point)}, {normal})*unit", *last)
    corners = [shape.vertices]
    if isinstance(shape, Mesh):
        corners = [tuple(shape.vertices[index] for index in face) for face in shape.faces]
    # Clockwise: then the normal of POV-Ray points to our side, from which `texture` is seen, not `interior_texture`.
    # Not by `scale unit`: a triangle that is transformed forgets which way its corners ran.
    triangles = [f"triangle {{ {', '.join(f'{vector(p)}*unit' for p in (a, c, b))} }}" for a, b, c in corners]
    return block("union", *triangles, *([also] if also else []), *last)
