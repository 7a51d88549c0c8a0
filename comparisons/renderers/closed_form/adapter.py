"""A second, independent reference: one sphere, triangle or plane with every local shading term, in closed form.

Written in vectorised NumPy without a look at the reference tracer: other intersection formulas, shadows decided by
convexity instead of rays, so that a fault shared by both is unlikely.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.records.renderings import FirstHits, RendererError, Rendering
from raytruth.comparisons.renderers.closed_form.geometry import (
    Hits,
    intersect_plane,
    intersect_sphere,
    intersect_triangle,
    is_unobstructed,
)
from raytruth.comparisons.renderers.closed_form.shading import background_radiance, surface_radiance
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.features import BACKGROUNDS, GEOMETRY, LIGHTS, LOCAL_TERMS, Feature, missing_features
from raytruth.scenes.requirements import required_features
from raytruth.scenes.shapes import Plane, Sphere

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rays
    from raytruth.scenes.materials import Material
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.shapes import Shape

EXPRESSES = GEOMETRY | {Feature.PLANES} | BACKGROUNDS | LIGHTS | LOCAL_TERMS
# No value depends on more than 2^8 rounded operations one after the other (about 100 with one light, and 8 for each
# further one), so that to first order another sequence of float64 operations differs by 2^8 roundoffs at most.
REORDERING_BITS = 8
FLOAT64_BITS = 53


class ClosedFormRenderer:
    """Scenes of one sphere, triangle or plane without mirrors and glass, in float64, with no ray offset."""

    name = "closed_form"
    integrators = (Integrator("local", r"E(e|DL)"),)
    error_model = ErrorModel(
        f"float64 with {REORDERING_BITS} bits for another order of operations",
        precision_bits=FLOAT64_BITS - REORDERING_BITS,
    )
    error_models = (("*", error_model),)  # our own formulas, in operations that every NumPy rounds alike
    install = "part of raytruth"

    def version(self) -> str:
        """The version of NumPy, which does the arithmetic."""
        return f"NumPy {np.__version__}"

    def refuses(self, scene: Scene) -> str | None:
        """Why the scene is not one sphere, triangle or plane with local terms only."""
        if scene.camera.inside is not None:
            return "its camera is inside a dielectric"
        count = sum(_primitive_count(shape) for shape in scene.objects)
        if count != 1:
            return f"it has {count} primitives, and closed_form has formulas for exactly one"
        if "rays" in _material(scene).light_from():
            return "its surface reflects or refracts, and closed_form has local terms only"
        return missing_features("closed_form", EXPRESSES, required_features(scene))

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """Evaluate the formulas in the calling process, since nothing in them can hang; `depth` does not matter.

        Raises RendererError for a scene that it refuses.
        """
        reason = self.refuses(scene)
        if reason is not None:
            raise RendererError(f"closed_form cannot render this scene because {reason}.")
        start = time.perf_counter()
        # A light in the hit point gives 0/0, a subnormal distance gives infinity: both count as no light, as specified.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore", under="ignore"):
            hits = _intersect(_one_shape(scene), rays)
            unobstructed = [is_unobstructed(light, _one_shape(scene), hits) for light in scene.lights]
            surface = surface_radiance(scene, _material(scene), hits, rays.directions, unobstructed)
        radiance = np.where(hits.is_hit[..., None], surface, background_radiance(scene.background, rays.directions))
        image = radiance.astype(np.float32)
        seconds = time.perf_counter() - start
        (folder / "log.txt").write_text(f"{self.version()}: {image.shape[1]}x{image.shape[0]} in {seconds:.3f} s\n")
        return Rendering(image, seconds, _first_hits(hits))


def _primitive_count(shape: Shape) -> int:
    return len(shape.faces) if shape.shape == "mesh" else 1


def _one_shape(scene: Scene) -> Shape:
    """The shape that holds the scene's only primitive."""
    return next(shape for shape in scene.objects if _primitive_count(shape))


def _material(scene: Scene) -> Material:
    return scene.materials[_one_shape(scene).material]


def _intersect(shape: Shape, rays: Rays) -> Hits:
    if isinstance(shape, Sphere):
        return intersect_sphere(rays, np.array(shape.center), shape.radius)
    if isinstance(shape, Plane):
        return intersect_plane(rays, np.array(shape.point), np.array(shape.normal))
    vertices = np.array(shape.vertices)
    if shape.shape == "mesh":
        vertices = vertices[list(shape.faces[0])]
    return intersect_triangle(rays, vertices)


def _first_hits(hits: Hits) -> FirstHits:
    """Position and normal are NaN where nothing is hit, so that nobody compares them by mistake."""
    nowhere = ~hits.is_hit[..., None]
    return FirstHits(
        depth=np.where(hits.is_hit, hits.distance, np.inf),
        position=np.where(nowhere, np.nan, hits.position),
        normal=np.where(nowhere, np.nan, hits.normal),
        primitive=np.where(hits.is_hit, 0, -1).astype(np.int64),
    )
