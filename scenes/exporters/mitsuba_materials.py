"""Materials and textures as Mitsuba's bsdfs and spectra."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree

from raytruth.scenes.exporters.mitsuba_elements import add_numbers, add_text
from raytruth.scenes.materials import Checkerboard, CheckerboardColor
from raytruth.scenes.media import index_of_medium

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from raytruth.scenes.materials import Material, Texture
    from raytruth.scenes.scene import Scene
    from raytruth.scenes.values import Color

BLACK: Color = (0.0, 0.0, 0.0)


def add_bsdf(root: Element, identifier: str, scene: Scene, material: Material) -> None:
    """The material as a bsdf that shapes can refer to."""
    if material.dielectric:
        bsdf = ElementTree.SubElement(root, "bsdf", type="dielectric", id=identifier)
        indices = {
            "int_ior": material.dielectric.index_of_refraction,
            "ext_ior": index_of_medium(scene, material.dielectric.outside),
        }
        add_numbers(bsdf, "float", **indices)
        return
    # Opaque bsdfs of Mitsuba are black from behind unless wrapped.
    wrapper = ElementTree.SubElement(root, "bsdf", type="twosided", id=identifier)
    if material.mirror:
        bsdf = ElementTree.SubElement(wrapper, "bsdf", type="conductor")
        add_text(bsdf, "material", "none")
        add_texture(bsdf, "specular_reflectance", material.mirror.reflectance)
    else:
        # Without a bsdf a shape would be grey: what only emits is black.
        bsdf = ElementTree.SubElement(wrapper, "bsdf", type="diffuse")
        add_texture(bsdf, "reflectance", material.diffuse.reflectance if material.diffuse else BLACK)


def checkerboard_of(material: Material) -> Checkerboard | None:
    """The checkerboard of a material's colour, which its texture coordinates must follow."""
    for texture in (
        material.diffuse.reflectance if material.diffuse else BLACK,
        material.emission.radiance if material.emission else BLACK,
    ):
        if isinstance(texture, CheckerboardColor):
            return texture.checkerboard
    return None


def add_texture(parent: Element, name: str, texture: Texture) -> None:
    """A colour, or a checkerboard over texture coordinates whose unit is two squares."""
    if not isinstance(texture, CheckerboardColor):
        ElementTree.SubElement(parent, "rgb", name=name, value=_triple(texture))
        return
    checkerboard = ElementTree.SubElement(parent, "texture", type="checkerboard", name=name)
    for color_name, color in (("color0", texture.checkerboard.even), ("color1", texture.checkerboard.odd)):
        # A plain rgb inside a texture is taken for a reflectance and may not exceed 1; a radiance may.
        spectrum = ElementTree.SubElement(checkerboard, "spectrum", type="srgb", name=color_name)
        ElementTree.SubElement(spectrum, "rgb", name="color", value=_triple(color))
        ElementTree.SubElement(spectrum, "boolean", name="unbounded", value="true")


def _triple(color: Color) -> str:
    return ", ".join(map(repr, color))
