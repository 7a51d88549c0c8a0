"""The media on both sides of a dielectric surface."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.scenes.materials import Dielectric
    from raytruth.scenes.scene import Scene


def index_of_medium(scene: Scene, name: str | None) -> float:
    """The index of refraction of the dielectric material of this name; 1 for None, which is empty space."""
    if name is None:
        return 1.0
    dielectric = scene.materials[name].dielectric
    assert dielectric is not None  # checked when the scene was loaded
    return dielectric.index_of_refraction


def relative_index(scene: Scene, dielectric: Dielectric) -> float:
    """The index of refraction inside, divided by that of the medium outside."""
    return dielectric.index_of_refraction / index_of_medium(scene, dielectric.outside)
