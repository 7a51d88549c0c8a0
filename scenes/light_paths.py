"""Light paths in Heckbert's notation, and whether two renderers sum the same ones on a scene.

A path is written from the eye to the light (Heckbert, "Adaptive Radiosity Textures for Bidirectional Ray Tracing",
1990, section 2, who writes it from the light): E the eye, S a mirror or dielectric, D a surface with a diffuse or
specular term, L a point or directional light, e an emitter or the background. Whitted's class is E S* (D L | e).

A renderer sums a class of paths, given as a regular expression. Two classes give the same image of a scene if they
hold the same paths among those that the scene can have, which follow from which surfaces can see which.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import regex

from raytruth.scenes.lights import shines
from raytruth.scenes.shapes import Mesh, Plane, Sphere, Triangle

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from raytruth.scenes.materials import LightSource, Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape

    Points = NDArray[np.float64]
    """Shape (n, 3)."""

WHITTED = "ES{{0,{depth}}}(DL|e)"
"""Whitted's class; `depth` is the scene's max_depth."""

LETTERS: dict[LightSource, str] = {"lights": "D", "rays": "S", "ambient light": "", "itself": ""}
"""What a surface with such a term is within a path: nothing, if the path can only end there."""


def whitted_class(scene: Scene) -> str:
    """The light paths that the scene's truth sums, as a regular expression over Heckbert's letters."""
    return WHITTED.format(depth=scene.max_depth)


def comparable_depth(scene: Scene, light_paths: str, has_depth: bool) -> int | str:
    """The depth at which a renderer's class gives the scene's truth, or why there is none.

    `light_paths` is a regular expression in which `{depth}` stands for the depth, if it has one. Of several depths
    that fit, the smallest is taken.
    """
    depths = range(scene.max_depth + 2) if has_depth else range(1)
    graph = _Graph(scene)
    difference = ""
    for depth in depths:
        found = _first_difference(graph, whitted_class(scene), light_paths.format(depth=depth), scene.max_depth + 2)
        if found is None:
            return depth
        difference = found
    return difference


def _first_difference(graph: _Graph, truth: str, other: str, longest: int) -> str | None:
    """A sentence on the shortest path of the scene that only one of the classes holds; None if there is none."""
    classes = (truth, other)

    def may_go_on(beginning: str) -> bool:
        """Whether a path of either class begins like this: without such a limit there were 2^longest to look at."""
        return any(regex.fullmatch(pattern, beginning, partial=True) for pattern in classes)

    for path in graph.paths(longest, may_go_on):
        in_truth, in_other = (regex.fullmatch(pattern, path) is not None for pattern in classes)
        if in_truth and not in_other:
            return f"the scene has light paths {path}, which Whitted's equation sums and this integrator does not"
        if in_other and not in_truth:
            return f"the scene has light paths {path}, which this integrator sums and Whitted's equation does not"
    return None


@dataclass(frozen=True)
class _Surface:
    """An object as light paths see it."""

    letters: str
    emits: bool
    lit: bool


class _Graph:
    """Which objects of a scene can see which, and what light can do there."""

    def __init__(self, scene: Scene) -> None:
        self.surfaces = [_surface(scene, scene.materials[shape.material]) for shape in scene.objects]
        self.background_shines = shines(scene.background)
        count = len(scene.objects)
        self.sees = [[_can_see(scene, i, j) for j in range(count)] for i in range(count)]

    def paths(self, longest: int, may_go_on: Callable[[str], bool]) -> Iterator[str]:
        """All kinds of paths that the scene can have, with at most `longest` surfaces, shortest first.

        A path whose beginning may not go on is left out, with all that begin like it.
        """
        everything = frozenset(range(len(self.surfaces)))
        if not self.background_shines and not any(surface.emits or surface.lit for surface in self.surfaces):
            return  # in the dark no path ends
        if self.background_shines or any(surface.emits for surface in self.surfaces):
            yield "Ee"
        waiting = {"E": everything}
        for _ in range(longest):
            longer: dict[str, frozenset[int]] = {}
            for path, visible in waiting.items():
                for letter in "SD":
                    here = frozenset(i for i in visible if letter in self.surfaces[i].letters)
                    if not here or not may_go_on(path + letter):
                        continue
                    seen = frozenset(j for i in here for j in everything if self.sees[i][j])
                    yield from self._ends(path + letter, here, seen)
                    longer[path + letter] = seen
            waiting = longer

    def _ends(self, path: str, here: frozenset[int], seen: frozenset[int]) -> Iterator[str]:
        """The light that may stand at the end: a point light reaches an eye by no mirror, since both have no size."""
        if path.endswith("D") and any(self.surfaces[i].lit for i in here):
            yield path + "L"
        if self.background_shines or any(self.surfaces[j].emits for j in seen):
            yield path + "e"


def _surface(scene: Scene, material: Material) -> _Surface:
    light_from = material.light_from()
    letters = "".join(LETTERS[source] for source in light_from)
    # What a surface gives back of the ambient light needs no path to a light, as if it were emitted.
    emits = "itself" in light_from or ("ambient light" in light_from and any(scene.ambient_light))
    return _Surface(letters, emits=emits, lit="lights" in light_from and bool(scene.lights))


def _can_see(scene: Scene, i: int, j: int) -> bool:
    """Whether some point of object i may see some point of object j: True unless it is certainly not so."""
    first, second = scene.objects[i], scene.objects[j]
    if isinstance(first, Sphere) and i == j:
        return scene.materials[first.material].dielectric is not None or _something_is_inside(scene, first)
    if isinstance(first, Sphere) or isinstance(second, Sphere):
        return True
    if isinstance(first, Plane):
        return i != j and not _lies_in(second, first)
    if isinstance(second, Plane):
        return not _lies_in(first, second)
    return not _is_flat(_corners(first) if i == j else np.concatenate([_corners(first), _corners(second)]))


def _something_is_inside(scene: Scene, sphere: Sphere) -> bool:
    """Whether a viewer may be inside: the camera, or a part of another object."""
    if _camera_is_inside(scene, sphere) or any(_cuts(shape, sphere) for shape in scene.objects):
        return True
    points = [_points(shape) for shape in scene.objects if shape is not sphere and not isinstance(shape, Plane)]
    if not points:
        return False
    distances = np.linalg.norm(np.concatenate(points) - np.array(sphere.center), axis=1)
    return bool((distances < sphere.radius).any())


def _camera_is_inside(scene: Scene, sphere: Sphere) -> bool:
    """Whether a camera ray may start inside: those of an orthographic camera start anywhere in its plane."""
    camera = scene.camera
    to_center = np.array(sphere.center) - np.array(camera.position)
    if camera.projection == "perspective":
        return bool(np.linalg.norm(to_center) < sphere.radius)
    forward = np.array(camera.look_at) - np.array(camera.position)
    return bool(abs(to_center @ forward) < sphere.radius * np.linalg.norm(forward))


def _cuts(shape: Shape, sphere: Sphere) -> bool:
    """Whether a plane may cut a sphere; one that touches it may, as far as rounding tells."""
    if not isinstance(shape, Plane):
        return False
    normal = np.array(shape.normal)
    return bool(abs(np.subtract(sphere.center, shape.point) @ normal) <= sphere.radius * np.linalg.norm(normal))


def _lies_in(shape: Triangle | Mesh | Plane, plane: Plane) -> bool:
    """Whether all of a flat shape surely lies in a plane that is perpendicular to an axis: nothing is rounded then."""
    axes = np.flatnonzero(plane.normal)
    if len(axes) != 1 or (isinstance(shape, Plane) and np.flatnonzero(shape.normal).tolist() != axes.tolist()):
        return False
    points = np.array([shape.point]) if isinstance(shape, Plane) else _corners(shape)
    return bool((points[:, axes[0]] == plane.point[axes[0]]).all())


def _points(shape: Sphere | Triangle | Mesh) -> Points:
    return np.array([shape.center]) if isinstance(shape, Sphere) else _corners(shape)


def _corners(shape: Triangle | Mesh) -> Points:
    """The corners of all faces."""
    if isinstance(shape, Triangle):
        return np.array(shape.vertices)
    corners: Points = np.array(shape.vertices)[np.array(shape.faces).ravel()]
    return corners


def _is_flat(corners: Points) -> bool:
    """Whether all points lie in one plane that is perpendicular to an axis, or belong to one triangle.

    Only what is decided without rounding counts: other planes are taken for curved, which is the safe side.
    """
    return len(corners) == 3 or bool((corners == corners[0]).all(axis=0).any())
