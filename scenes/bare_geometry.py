"""A scene's geometry alone: what first hits depend on."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.scenes.lights import ConstantBackground
from raytruth.scenes.materials import Diffuse, Material

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

# Of a single grey material, which every renderer has.
GREY = Material(diffuse=Diffuse(reflectance=(0.5, 0.5, 0.5)))


def bare_geometry(scene: Scene) -> Scene:
    """The scene's shapes and camera in the dark, all of one diffuse material; primitives keep their numbers.

    What is hit first does not depend on light or material, so who lacks a term of the scene can still be asked for it.
    """
    return scene.model_copy(
        update={
            "convention": "radiometric",
            "max_depth": 0,
            "camera": scene.camera.model_copy(update={"inside": None}),
            "background": ConstantBackground(color=(0.0, 0.0, 0.0)),
            "ambient_light": (0.0, 0.0, 0.0),
            "lights": (),
            "materials": {"grey": GREY},
            "objects": tuple(shape.model_copy(update={"material": "grey"}) for shape in scene.objects),
        }
    )
