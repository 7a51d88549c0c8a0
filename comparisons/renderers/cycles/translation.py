"""A scene as a job for Cycles: its light in parts that Cycles sums without chance, or with no more than it must.

Cycles is a path tracer. It follows a path up to a number of bounces, of which each kind has a limit of its own, and
takes light at each vertex: from one lamp, and from an emitter or the background that a ray meets. What it does at the
last one differs. `PATH_RAY_TERMINATE_AFTER_TRANSPARENT` (src/kernel/integrator/path_state.h, path_state_next) is set
after the bounce that reaches a limit; the surface met then gives its emission, but neither takes light from a lamp nor
sends a ray on. The limits are one more than Blender's settings (src/scene/integrator.cpp, device_update). So with n
bounces, of which none is diffuse, it sums E S{0,n} D L, E S{0,n+1} e and E S{0,n} D e.

With all emission dark the first alone is left, and with all diffuse terms black the second. So Whitted's class of
depth n, E S{0,n} (D L | e), is the sum of these images: for each lamp one in which nothing else shines, with n
bounces, since Cycles picks one of several lamps at random; and one of what shines by itself, without diffuse terms,
with n - 1 bounces, or for n = 0 without mirrors and glass.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.renderers.cycles.job import Ball, Camera, Closure, Job, Lamp, Mesh, Part, Texture
from raytruth.scenes.exporters.triangle_soup import triangle_lists
from raytruth.scenes.lights import ConstantBackground, PointLight, shines
from raytruth.scenes.materials import CheckerboardColor
from raytruth.scenes.media import relative_index
from raytruth.scenes.shapes import Sphere

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from raytruth.comparisons.renderers.cycles.job import Triple
    from raytruth.scenes.lights import Background, Light
    from raytruth.scenes.materials import Material
    from raytruth.scenes.materials import Texture as SceneTexture
    from raytruth.scenes.scene import Scene

WHITE = Texture(even=(1.0, 1.0, 1.0))
AXES = {"xy": (0, 1), "xz": (0, 2), "yz": (1, 2)}
# Twice as far as the farthest corner of the box around all objects: what is seen is nearer for any rounding.
BEYOND_ALL = 2.0


def job_of(scene: Scene, depth: int, batches: int, batch_samples: int) -> Job:
    """The job for all light that Whitted's class of this depth sums."""
    names = list(dict.fromkeys(shape.material for shape in scene.objects))
    materials = [scene.materials[name] for name in names]
    return Job(
        camera=camera_of(scene),
        objects=tuple(_objects(scene, names)),
        parts=tuple(parts_of(scene, materials, depth)),
        batches=batches,
        batch_samples=batch_samples,
    )


def parts_of(scene: Scene, materials: list[Material], depth: int) -> Iterator[Part]:
    """The parts of a scene's light: one for each lamp, and always one for what shines by itself."""
    onward = [_specular_closures(scene, material) for material in materials]
    is_lit = bool(scene.lights) and any(material.diffuse for material in materials)
    if is_lit:
        lit = tuple((*_diffuse_closures(m), *closures) for m, closures in zip(materials, onward, strict=True))
        for number, light in enumerate(scene.lights):
            yield Part(name=f"lamp-{number}", materials=lit, lamps=(_lamp(light),), bounces=depth)
    if is_lit and not shines(scene.background) and not any(material.emission for material in materials):
        return
    shining = tuple(
        (*_emission_closures(m), *(closures if depth else ())) for m, closures in zip(materials, onward, strict=True)
    )
    background = _background(scene.background) if shines(scene.background) else None
    yield Part(name="emission", materials=shining, background=background, bounces=max(0, depth - 1))


def camera_of(scene: Scene) -> Camera:
    """The scene's camera for Blender: its axes, its position and its extent."""
    camera = scene.camera
    forward = _unit(np.subtract(camera.look_at, camera.position))
    right = _unit(np.cross(forward, camera.up))
    if camera.projection == "perspective":
        tangent, view_height = float(np.tan(np.radians(camera.vertical_field_of_view / 2))), 1.0
    else:
        tangent, view_height = None, camera.view_height
    return Camera(
        axes=(_triple(right), _triple(np.cross(right, forward)), _triple(-forward)),
        position=camera.position,
        tangent=tangent,
        view_height=view_height,
        far=_far(scene),
        width=camera.width,
        height=camera.height,
    )


def _far(scene: Scene) -> float:
    """A distance beyond all objects: no corner of a box around one of them is farther."""
    corners = [np.array(scene.camera.position)[None]]
    for shape in scene.objects:
        if isinstance(shape, Sphere):
            corners.append(np.array([np.subtract(shape.center, shape.radius), np.add(shape.center, shape.radius)]))
        else:
            corners.append(np.array(triangle_lists(shape)[0]))
    both = np.concatenate(corners)
    return BEYOND_ALL * float(np.linalg.norm(both.max(axis=0) - both.min(axis=0)))


def _objects(scene: Scene, names: list[str]) -> Iterator[Mesh | Ball]:
    for shape in scene.objects:
        material = names.index(shape.material)
        if isinstance(shape, Sphere):
            yield Ball(center=shape.center, radius=shape.radius, material=material)
        else:
            vertices, faces = triangle_lists(shape)
            yield Mesh(vertices=vertices, faces=faces, material=material)


def _diffuse_closures(material: Material) -> tuple[Closure, ...]:
    return (Closure(kind="diffuse", color=_texture(material.diffuse.reflectance)),) if material.diffuse else ()


def _emission_closures(material: Material) -> tuple[Closure, ...]:
    return (Closure(kind="emission", color=_texture(material.emission.radiance)),) if material.emission else ()


def _specular_closures(scene: Scene, material: Material) -> tuple[Closure, ...]:
    if material.mirror:
        return (Closure(kind="mirror", color=Texture(even=material.mirror.reflectance)),)
    if material.dielectric:
        return (Closure(kind="glass", color=WHITE, index=relative_index(scene, material.dielectric)),)
    return ()


def _texture(texture: SceneTexture) -> Texture:
    if isinstance(texture, CheckerboardColor):
        board = texture.checkerboard
        return Texture(even=board.even, odd=board.odd, size=board.size, axes=AXES[board.plane], offset=board.offset)
    return Texture(even=texture)


def _lamp(light: Light) -> Lamp:
    if isinstance(light, PointLight):
        return Lamp(kind="POINT", vector=light.position, strength=light.intensity)
    return Lamp(kind="SUN", vector=_triple(_unit(np.array(light.direction))), strength=light.irradiance)


def _background(background: Background) -> tuple[Triple, Triple]:
    if isinstance(background, ConstantBackground):
        return background.color, background.color
    return background.bottom, background.top


def _unit(vector: NDArray[np.float64]) -> NDArray[np.float64]:
    unit: NDArray[np.float64] = vector / np.linalg.norm(vector)
    return unit


def _triple(vector: NDArray[np.float64]) -> Triple:
    x, y, z = vector.tolist()
    return x, y, z
