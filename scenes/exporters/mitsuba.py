"""Writes a scene as a Mitsuba 3 scene file that a person can open there, with the files it needs beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal
from xml.etree import ElementTree

import numpy as np

from raytruth.scenes.exporters.mitsuba_elements import add_comment, add_numbers, add_text, add_vector
from raytruth.scenes.exporters.mitsuba_files import checkerboard_coordinates, write_gradient, write_triangles
from raytruth.scenes.exporters.mitsuba_limits import refuses, reversed_primitives
from raytruth.scenes.exporters.mitsuba_materials import add_bsdf, add_texture, checkerboard_of
from raytruth.scenes.lights import GradientBackground, PointLight, shines
from raytruth.scenes.requirements import used_materials
from raytruth.scenes.shapes import Mesh, Plane, Sphere

if TYPE_CHECKING:
    from pathlib import Path
    from xml.etree.ElementTree import Element

    from numpy.typing import NDArray

    from raytruth.scenes.lights import Light
    from raytruth.scenes.scene import Scene

SCENE_FILE = "scene.xml"
GRADIENT_FILE = "background.exr"
# Mitsuba starts its rays on the near plane and ends them on the far one. Coordinates reach 1e12, so two points are
# at most 2√3·1e12 apart. So near a plane disturbs no direction: all are within 1.6e-7, as with Mitsuba's own 1e-2.
NEAR_CLIP = 1e-9
FAR_CLIP = 1e13
# Russian roulette would end paths at random from this depth on; no depth reaches it.
NO_ROULETTE = 1_000_000
# Mitsuba's max_depth for light that has met one surface.
DIRECT_LIGHT = 2
# For a person who opens a scene with glass: noise of a few percent, in a second or two.
PICTURE_SAMPLES = 256

Source = int | Literal["emission"]


def light_sources(scene: Scene) -> list[Source]:
    """What sends light: the index of each light, and `emission` where a surface or the background shines."""
    sources: list[Source] = list(range(len(scene.lights)))
    if shines(scene.background) or any(scene.materials[shape.material].emission for shape in scene.objects):
        sources.append("emission")
    return sources


def first_primitives_of(scene: Scene) -> list[int]:
    """For each object the number of its first primitive: spheres come first, then triangles, in the objects' order."""
    first = [0] * len(scene.objects)
    count = 0
    for spheres in (True, False):
        for index, shape in enumerate(scene.objects):
            if isinstance(shape, Sphere) == spheres:
                first[index] = count
                count += len(shape.faces) if isinstance(shape, Mesh) else 1
    return first


def shape_id(object_index: int) -> str:
    """The name in the Mitsuba file of `scene.objects[object_index]`."""
    return f"object-{object_index}"


def export_mitsuba(
    scene: Scene,
    folder: Path,
    *,
    integrator: str = "path",
    max_depth: int,
    only_source: Source | None = None,
    file_name: str = SCENE_FILE,
) -> Path:
    """Write `scene` to `folder` and return the path of the Mitsuba scene file.

    `integrator` is `path`, `direct`, or `ptracer`, which traces direct light forward. `max_depth` (`path` only) is
    Mitsuba's: 1 shows emitters alone, each bounce adds 1. With `only_source`, all other sources of light are dark:
    since light adds up, so do the images. Raises ValueError where `refuses(scene)`.
    """
    reason = refuses(scene)
    if reason:
        raise ValueError(f"scene {scene.name!r} cannot be written for Mitsuba, because {reason}")
    root = ElementTree.Element("scene", version="3.0.0")
    add_comment(root, f"{scene.name or 'scene'}: {scene.purpose}")
    _add_integrator(root, integrator, max_depth)
    _add_camera(root, scene, integrator)
    for index, light in enumerate(scene.lights):
        if only_source in (None, index):
            _add_light(root, light)
    emission = only_source in (None, "emission")
    if emission and shines(scene.background):
        _add_background(root, scene, folder)
    material_ids: dict[str, str] = {}
    for name in dict.fromkeys(shape.material for shape in scene.objects):
        # Names are the author's and may hold what Mitsuba gives a meaning ('$', '.'); ids are ours.
        material_ids[name] = f"material-{len(material_ids)}"
        add_comment(root, f"material {name}")
        add_bsdf(root, material_ids[name], scene, scene.materials[name])
    _add_objects(root, scene, folder, material_ids, emission=emission)
    ElementTree.indent(root, "    ")
    path = folder / file_name
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)
    return path


def _add_integrator(root: Element, name: str, max_depth: int) -> None:
    integrator = ElementTree.SubElement(root, "integrator", type=name)
    if name == "path":
        add_numbers(integrator, "integer", max_depth=max_depth, rr_depth=NO_ROULETTE)
    elif name == "ptracer":
        add_numbers(integrator, "integer", max_depth=DIRECT_LIGHT, rr_depth=NO_ROULETTE)


def _add_camera(root: Element, scene: Scene, integrator: str) -> None:
    camera = scene.camera
    sensor = ElementTree.SubElement(root, "sensor", type=camera.projection)
    add_numbers(sensor, "float", near_clip=NEAR_CLIP, far_clip=FAR_CLIP)
    to_world = ElementTree.SubElement(sensor, "transform", name="to_world")
    if camera.projection == "perspective":
        add_numbers(sensor, "float", fov=camera.vertical_field_of_view)
        add_text(sensor, "fov_axis", "y")
    else:
        # Mitsuba shows x from -1 to 1 over the image's width, and as much of y as the square pixels leave.
        half_width = camera.view_height / 2 * camera.width / camera.height
        ElementTree.SubElement(to_world, "scale", x=repr(half_width), y=repr(half_width))
    view = {"origin": camera.position, "target": camera.look_at, "up": camera.up}
    ElementTree.SubElement(to_world, "lookat", {name: ", ".join(map(repr, value)) for name, value in view.items()})
    film = ElementTree.SubElement(sensor, "film", type="hdrfilm")
    add_numbers(film, "integer", width=camera.width, height=camera.height)
    add_text(film, "pixel_format", "rgb")
    add_text(film, "component_format", "float32")
    ElementTree.SubElement(film, "rfilter", type="box")
    _add_sampler(sensor, scene, integrator)


def _add_sampler(sensor: Element, scene: Scene, integrator: str) -> None:
    if integrator == "ptracer":
        # Where light goes is random in any case; stratified over pixels, it would go to the same few places every time.
        add_comment(sensor, "so many light paths for each pixel, which end on any of them")
        sampler = ElementTree.SubElement(sensor, "sampler", type="independent")
        add_numbers(sampler, "integer", sample_count=PICTURE_SAMPLES)
    elif any(material.dielectric for material in used_materials(scene)):
        add_comment(sensor, "glass reflects or refracts each ray at random: a picture takes many, all over the pixel")
        sampler = ElementTree.SubElement(sensor, "sampler", type="independent")
        add_numbers(sampler, "integer", sample_count=PICTURE_SAMPLES)
    else:
        add_comment(sensor, "one ray through the centre of each pixel")
        sampler = ElementTree.SubElement(sensor, "sampler", type="stratified")
        add_numbers(sampler, "integer", sample_count=1)
        ElementTree.SubElement(sampler, "boolean", name="jitter", value="false")


def _add_light(root: Element, light: Light) -> None:
    if isinstance(light, PointLight):
        emitter = ElementTree.SubElement(root, "emitter", type="point")
        add_vector(emitter, "point", "position", light.position)
        add_texture(emitter, "intensity", light.intensity)
    else:
        emitter = ElementTree.SubElement(root, "emitter", type="directional")
        add_vector(emitter, "vector", "direction", light.direction)
        add_texture(emitter, "irradiance", light.irradiance)


def _add_background(root: Element, scene: Scene, folder: Path) -> None:
    if isinstance(scene.background, GradientBackground):
        write_gradient(folder / GRADIENT_FILE, scene.background)
        emitter = ElementTree.SubElement(root, "emitter", type="envmap")
        add_text(emitter, "filename", GRADIENT_FILE)
    else:
        emitter = ElementTree.SubElement(root, "emitter", type="constant")
        add_texture(emitter, "radiance", scene.background.color)


def _add_objects(root: Element, scene: Scene, folder: Path, material_ids: dict[str, str], *, emission: bool) -> None:
    reverse = reversed_primitives(scene)
    first_primitives = first_primitives_of(scene)
    for index, shape in enumerate(scene.objects):
        first = first_primitives[index]
        if isinstance(shape, Sphere):
            element = ElementTree.SubElement(root, "shape", type="sphere", id=shape_id(index))
            add_vector(element, "point", "center", shape.center)
            add_numbers(element, "float", radius=shape.radius)
            if reverse[first]:
                add_comment(element, "the camera is inside: this is the side that shines")
                ElementTree.SubElement(element, "boolean", name="flip_normals", value="true")
        else:
            element = _add_triangles(root, scene, folder, index, reverse[first:])
        ElementTree.SubElement(element, "ref", id=material_ids[shape.material])
        emitted = scene.materials[shape.material].emission
        if emitted and emission:
            emitter = ElementTree.SubElement(element, "emitter", type="area")
            add_texture(emitter, "radiance", emitted.radiance)


def _add_triangles(root: Element, scene: Scene, folder: Path, index: int, reverse: NDArray[np.bool_]) -> Element:
    """A triangle or a mesh, in a file of its own since Mitsuba has neither inline."""
    shape = scene.objects[index]
    assert not isinstance(shape, Sphere | Plane)  # the caller has looked
    vertices = np.array(shape.vertices, dtype=np.float64)
    faces = np.array(shape.faces if isinstance(shape, Mesh) else [(0, 1, 2)], dtype=np.int64)
    turned = faces.copy()
    turned[reverse[: len(faces)]] = faces[reverse[: len(faces)], ::-1]
    checkerboard = checkerboard_of(scene.materials[shape.material])
    coordinates = checkerboard_coordinates(checkerboard, vertices) if checkerboard else None
    write_triangles(folder / f"{shape_id(index)}.ply", vertices, turned, coordinates)
    element = ElementTree.SubElement(root, "shape", type="ply", id=shape_id(index))
    add_text(element, "filename", f"{shape_id(index)}.ply")
    ElementTree.SubElement(element, "boolean", name="face_normals", value="true")
    return element
