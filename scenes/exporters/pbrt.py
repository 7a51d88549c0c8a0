"""Writes a scene as a scene file of pbrt-v4. Files named are those of its source, src/pbrt/.

Colours are written as they are and come out as they are. A light's RGB multiplies the illuminant of the colour space,
and its `scale` is divided by what that illuminant brings in Y (lights.cpp, `SpectrumToPhotometric`), so that (1, 1, 1)
has Y = 1; the sensor "cie1931" with its defaults takes just this Y for white (film.cpp, PixelSensor::Create). So
neither `scale` nor `power` is stated. They are meant as sRGB's linear RGB, which is pbrt's default colour space.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.exporters.pbrt_limits import depth_of, notes, refuses
from raytruth.scenes.exporters.pbrt_text import attributes, comment, directive, numbers
from raytruth.scenes.exporters.triangle_soup import triangle_lists
from raytruth.scenes.lights import ConstantBackground, PointLight, shines
from raytruth.scenes.materials import CheckerboardColor
from raytruth.scenes.media import relative_index
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from raytruth.scenes.exporters.pbrt_text import Value
    from raytruth.scenes.lights import Light
    from raytruth.scenes.materials import Checkerboard, Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape

SCENE_FILE = "scene.pbrt"
# Each sample is a spectrum at four wavelengths, and meets one light and one way through glass: noise of a few percent.
PICTURE_SAMPLES = 256


def export_pbrt(scene: Scene, folder: Path) -> Path:
    """Write `scene` to `folder` and return the path of the file.

    Raises ValueError where `refuses(scene)`, OSError if it cannot be written.
    """
    reason = refuses(scene)
    if reason:
        raise ValueError(f"scene {scene.name!r} cannot be written for pbrt, because {reason}")
    path = folder / SCENE_FILE
    path.write_text("".join((*_options(scene), "\nWorldBegin\n\n", *_world(scene))), encoding="utf-8", newline="\n")
    return path


def _options(scene: Scene) -> Iterator[str]:
    yield comment(f"{scene.name or 'scene'}: {scene.purpose}")
    yield from map(comment, notes(scene))
    yield "\n"
    yield comment("one point of each pixel, its centre; textures at points, not averaged over a pixel")
    yield 'Option "disablepixeljitter" true\nOption "disabletexturefiltering" true\n'
    depth = depth_of(scene)
    # Where no depth has the scene's light paths, one more than max_depth: a surface at the end that is lit.
    maxdepth = scene.max_depth + 1 if isinstance(depth, str) else depth
    yield directive("Integrator", "path", {"integer maxdepth": maxdepth})
    yield directive("Sampler", "zsobol", {"integer pixelsamples": PICTURE_SAMPLES})
    yield directive("PixelFilter", "box", {"float xradius": 0.5, "float yradius": 0.5})
    yield from _camera(scene)


def _camera(scene: Scene) -> Iterator[str]:
    camera = scene.camera
    size: dict[str, Value] = {"integer xresolution": camera.width, "integer yresolution": camera.height}
    yield directive("Film", "rgb", {"string filename": "scene.exr", **size, "bool savefp16": False})
    # util/transform.cpp, LookAt: its x is up × forward, which points to the left in axes that are right-handed.
    yield comment("the camera's axes are left-handed, and the scene's are not")
    yield "Scale -1 1 1\n"
    yield f"LookAt {numbers(camera.position)}\n    {numbers(camera.look_at)}\n    {numbers(camera.up)}\n"
    aspect_ratio = camera.width / camera.height
    if camera.projection == "perspective":
        # `fov` spans −1 to 1 of the window: by default that is the shorter side, with this one always the height.
        window = (-aspect_ratio, aspect_ratio, -1.0, 1.0)
        lens: dict[str, Value] = {"float fov": camera.vertical_field_of_view}
    else:
        half = camera.view_height / 2
        window = (-half * aspect_ratio, half * aspect_ratio, -half, half)
        lens = {}
    yield directive("Camera", camera.projection, {**lens, "float screenwindow": window})


def _world(scene: Scene) -> Iterator[str]:
    if isinstance(scene.background, ConstantBackground) and shines(scene.background):
        yield directive("LightSource", "infinite", {"rgb L": scene.background.color})
    yield from map(_light, scene.lights)
    materials = {name: f"material-{i}" for i, name in enumerate(dict.fromkeys(s.material for s in scene.objects))}
    for name, short in materials.items():
        # Names are the author's and may hold quotes; these are ours.
        yield "\n" + comment(f"material {name}")
        yield from _material(scene, short, scene.materials[name])
    yield "\n"
    yield from (_object(scene, shape, materials[shape.material]) for shape in scene.objects)


def _light(light: Light) -> str:
    if isinstance(light, PointLight):
        return directive("LightSource", "point", {"rgb I": light.intensity, "point3 from": light.position})
    # lights.h, DistantLight: a surface that faces it receives the irradiance L.
    toward: dict[str, Value] = {"point3 from": (0.0, 0.0, 0.0), "point3 to": light.direction}
    return directive("LightSource", "distant", {"rgb L": light.irradiance, **toward})


def _material(scene: Scene, short: str, material: Material) -> Iterator[str]:
    if material.dielectric:
        # pbrt's surfaces decide what is on either side, as the scene's do, and not a ray's history.
        index = {"float eta": relative_index(scene, material.dielectric)}
        yield directive("MakeNamedMaterial", short, {"string type": "dielectric", **index})
        return
    reflectance = material.diffuse.reflectance if material.diffuse else (0.0, 0.0, 0.0)
    if isinstance(reflectance, CheckerboardColor):
        yield _checkerboard(short, reflectance.checkerboard)
        color: dict[str, Value] = {"texture reflectance": short}
    else:
        color = {"rgb reflectance": reflectance}
    yield directive("MakeNamedMaterial", short, {"string type": "diffuse", **color})


def _checkerboard(short: str, board: Checkerboard) -> str:
    """Squares of side 1 of (p·v1 + udelta, p·v2 + vdelta), and `tex1` where their numbers add up to an even one.

    As textures.h, PlanarMapping, and textures.cpp, Checkerboard, have it.
    """
    axes = [[1 / board.size if axis == letter else 0.0 for axis in "xyz"] for letter in board.plane]
    shifts = [-offset / board.size for offset in board.offset]
    parameters: dict[str, Value] = {"rgb tex1": board.even, "rgb tex2": board.odd, "string mapping": "planar"}
    parameters |= {"vector3 v1": axes[0], "vector3 v2": axes[1], "float udelta": shifts[0], "float vdelta": shifts[1]}
    return directive(f'Texture "{short}" "spectrum"', "checkerboard", parameters)


def _object(scene: Scene, shape: Shape, material: str) -> str:
    lines = [f'NamedMaterial "{material}"\n']
    emission = scene.materials[shape.material].emission
    if emission:
        radiance = emission.radiance
        assert isinstance(radiance, tuple)  # checkerboards are refused
        lines.append(directive("AreaLightSource", "diffuse", {"rgb L": radiance, "bool twosided": True}))
    if isinstance(shape, Sphere):
        lines += [f"Translate {numbers(shape.center)}\n", directive("Shape", "sphere", {"float radius": shape.radius})]
    else:
        vertices, faces = triangle_lists(shape)
        corners = [coordinate for vertex in vertices for coordinate in vertex]
        indices = [index for face in faces for index in face]
        lines.append(directive("Shape", "trianglemesh", {"point3 P": corners, "integer indices": indices}))
    return attributes(*lines)
