"""An adapter: it tells raytruth what the renderer `flat` is, and how a scene is rendered with it.

`flat` shows spheres in their own light and in ambient light, and knows neither lamps nor mirrors nor glass. The adapter
of a real renderer writes the scene in its format and starts it; this one starts the second half of the file.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.processes.worker_results import read_arrays, write_arrays
from raytruth.comparisons.records.renderings import Rendering
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.exporters.json_scene import export_json
from raytruth.scenes.features import Feature, missing_features
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from raytruth.comparisons.records.renderings import Rays
    from raytruth.scenes.scene import Scene

# What the renderer is known to have: what is added to scenes later is refused by itself.
EXPRESSES = frozenset(
    {Feature.PERSPECTIVE, Feature.SPHERES, Feature.AMBIENT, Feature.EMISSION, Feature.BACKGROUND, Feature.RADIOMETRIC}
)
SECONDS = 60.0  # the largest image with a handful of spheres takes less
MEMORY_BYTES = 8 << 30  # of address space, of which NumPy's threads reserve much


class Flat:
    """The renderer, obeying the protocol Renderer."""

    name = "flat"
    # Its rays end where they meet the first surface, which glows or does not.
    integrators = (Integrator("flat", "Ee"),)
    # Float64, with room for formulas and an order of operations of its own; for all versions whose number begins so.
    error_models = (("flat 1.*", ErrorModel("float64 with 14 bits for other formulas", precision_bits=39)),)
    install = "pip install raytruth-flat"

    def version(self) -> str | None:
        """Name and version; None where it cannot run here. A renderer is asked, in a process of its own."""
        return "flat 1.0"

    def refuses(self, scene: Scene) -> str | None:
        """Why it cannot express the scene, in a clause that follows 'because'; None if it can."""
        return missing_features("flat", EXPRESSES, required_features(scene))

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """It draws no random numbers."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """Render in a process of its own, so that a crash or a hang is the verdict `error`, and no more."""
        scene_file = export_json(scene, folder)
        write_arrays(folder / "rays.npz", {"origins": rays.origins, "directions": rays.directions})
        start = time.perf_counter()
        command = [sys.executable, "-m", "raytruth_flat", scene_file.name]
        run_isolated(command, folder, seconds=SECONDS, memory_bytes=MEMORY_BYTES)
        seconds = time.perf_counter() - start
        image = read_arrays(folder / "picture.npz", {"image": rays.origins.shape}, "flat")["image"]
        return Rendering(image.astype(np.float32), seconds)


def main(scene_file: str) -> None:
    """The renderer itself: the colour of the nearest sphere along each ray."""
    scene = json.loads(Path(scene_file).read_text(encoding="utf-8"))
    with np.load("rays.npz") as rays:
        origins, directions = rays["origins"], rays["directions"]
    image = np.broadcast_to((scene.get("background") or {"color": [0, 0, 0]})["color"], origins.shape).astype(float)
    nearest = np.full(origins.shape[:2], np.inf)
    for shape in scene["objects"]:
        to_origin = origins - shape["center"]
        b = (directions * to_origin).sum(axis=2)
        foot = to_origin - b[..., None] * directions
        left = shape["radius"] ** 2 - (foot**2).sum(axis=2)
        half = np.sqrt(np.maximum(left, 0))
        distance = np.where(-b - half > 0, -b - half, -b + half)
        is_nearer = (left >= 0) & (distance > 0) & (distance < nearest)
        nearest[is_nearer] = distance[is_nearer]
        image[is_nearer] = colour_of(scene["materials"][shape["material"]], scene)
    np.savez("picture.npz", image=image)


def colour_of(material: dict, scene: dict) -> np.ndarray:
    """Its own light, and its answer to ambient light."""
    emission = (material.get("emission") or {"radiance": [0, 0, 0]})["radiance"]
    ambient = (material.get("ambient") or {"reflectance": [0, 0, 0]})["reflectance"]
    return np.array(emission) + np.array(ambient) * scene.get("ambient_light", [0, 0, 0])


if __name__ == "__main__":
    main(sys.argv[1])
