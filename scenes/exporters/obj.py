"""Writes a scene's triangles and materials as Wavefront OBJ and MTL files.

MTL means what its formulas say: "MTL material format", excerpt from Alias|Wavefront's File Formats, version 4.2 (1995),
"illum". `Ke`, emission, is not in it, but programs commonly write and read it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.exporters.comments import one_line
from raytruth.scenes.exporters.obj_lines import face_lines, vertex_lines
from raytruth.scenes.exporters.triangle_soup import triangle_lists
from raytruth.scenes.features import Feature, missing_features
from raytruth.scenes.lights import shines
from raytruth.scenes.materials import CheckerboardColor
from raytruth.scenes.planes import refuses_planes
from raytruth.scenes.requirements import used_materials
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.values import Color

SCENE_FILE = "scene.obj"
MATERIAL_FILE = "scene.mtl"
BLACK = (0.0, 0.0, 0.0)
# Of materials, whatever light the scene has: lights are left out.
EXPRESSES = frozenset({Feature.AMBIENT, Feature.DIFFUSE, Feature.BLINN, Feature.MIRRORS, Feature.EMISSION})


def refuses(scene: Scene) -> str | None:
    """Why OBJ cannot express the objects of this scene, in one clause that follows 'because'; None if it can."""
    if any(isinstance(shape, Sphere) for shape in scene.objects):
        return "OBJ has no spheres, and triangles in their place would be other surfaces"
    without_planes = refuses_planes("OBJ", scene)
    if without_planes:
        return without_planes
    reasons = (_refuses_material(material) for material in used_materials(scene))
    return next((reason for reason in reasons if reason), None)


def _refuses_material(material: Material) -> str | None:
    features = material.features()
    if Feature.CHECKERBOARD in features:
        return "MTL has textures as images only, and an image of a checkerboard has no exact edges"
    if material.dielectric:
        return "MTL names a Fresnel function for glass and does not say which"
    if material.specular and material.specular.model == "phong":
        return "the highlight of MTL is Blinn's, and here one is Phong's"
    if material.mirror and (not material.specular or material.specular.reflectance != material.mirror.reflectance):
        return "a mirror of MTL also shows highlights of the same colour"
    return missing_features("OBJ", EXPRESSES, features)


def notes(scene: Scene) -> list[str]:
    """What is left out, each in one clause."""
    found = ["the camera is left out with the image's size and max_depth, since OBJ has none of them"]
    if scene.lights:
        found.append("the lights are left out, since OBJ has none")
    if any(scene.ambient_light):
        found.append("the ambient light is left out, since OBJ has none")
    if shines(scene.background):
        found.append("the background is left out, since OBJ has none")
    return found


def export_obj(scene: Scene, folder: Path) -> Path:
    """Write `scene` to `folder` and return the path of the OBJ file; its materials are in an MTL file beside it.

    Raises ValueError where `refuses(scene)`, OSError if it cannot be written.
    """
    reason = refuses(scene)
    if reason:
        raise ValueError(f"scene {scene.name!r} cannot be written as OBJ, because {reason}")
    # Names are the author's and may hold spaces, which end a name; these are ours.
    names = {name: f"material-{i}" for i, name in enumerate(dict.fromkeys(shape.material for shape in scene.objects))}
    materials = (line for name, short in names.items() for line in _material(short, name, scene.materials[name]))
    path = folder / SCENE_FILE
    path.write_text("".join(_objects(scene, names)), encoding="utf-8", newline="\n")
    (folder / MATERIAL_FILE).write_text("".join(materials), encoding="utf-8", newline="\n")
    return path


def _comment(text: str) -> str:
    # A backslash at the end of a line would continue it.
    return f"# {one_line(text)}".rstrip("\\") + "\n"


def _objects(scene: Scene, names: dict[str, str]) -> Iterator[str]:
    yield _comment(f"{scene.name or 'scene'}: {scene.purpose}")
    yield from map(_comment, notes(scene))
    yield f"mtllib {MATERIAL_FILE}\n"
    first = 1
    for index, shape in enumerate(scene.objects):
        assert not isinstance(shape, Sphere)  # such scenes are refused
        vertices, faces = triangle_lists(shape)
        yield f"o object-{index}\n"
        yield from vertex_lines(vertices)
        # After the vertices: some readers begin another object at this line, and lose what stands before it.
        yield f"usemtl {names[shape.material]}\n"
        yield from face_lines(faces, first)
        first += len(vertices)


def _material(short: str, name: str, material: Material) -> Iterator[str]:
    yield _comment(f"material {name}")
    yield f"newmtl {short}\n"
    yield _color("Ka", material.ambient.reflectance if material.ambient else BLACK)
    yield _color("Kd", _plain(material.diffuse.reflectance) if material.diffuse else BLACK)
    if material.specular:
        yield _color("Ks", material.specular.reflectance)
        yield f"Ns {material.specular.exponent!r}\n"
    if material.emission:
        yield _color("Ke", _plain(material.emission.radiance))
    yield f"illum {_illumination_model(material)}\n"


def _illumination_model(material: Material) -> int:
    """1: ambient and diffuse; 2: and Blinn's highlight; 3: and what a mirror shows."""
    if material.mirror:
        return 3
    return 2 if material.specular else 1


def _plain(color: Color | CheckerboardColor) -> Color:
    assert not isinstance(color, CheckerboardColor)  # such scenes are refused
    return color


def _color(keyword: str, color: Color) -> str:
    return f"{keyword} {' '.join(map(repr, color))}\n"
