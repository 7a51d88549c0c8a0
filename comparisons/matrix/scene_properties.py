"""Properties of scenes in which a renderer is known to be wrong: what a waiver is about in place of one scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.scenes.scene import Scene

Property = Literal["nested dielectrics"]


def has_nested_dielectrics(scene: Scene) -> bool:
    """Whether a transparent object lies inside another: a bubble in glass, a stone in water."""
    dielectrics = (material.dielectric for material in used_materials(scene))
    return any(dielectric is not None and dielectric.outside is not None for dielectric in dielectrics)


PROPERTIES: dict[Property, Callable[[Scene], bool]] = {"nested dielectrics": has_nested_dielectrics}
