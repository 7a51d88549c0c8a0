"""Materials in glTF's metallic-roughness model, by those of its parameters that make it exact.

Without a specular layer (KHR_materials_specular: "A value of zero disables the specular reflection, resulting in a
pure diffuse material") it is Lambert's term. With an index of refraction of 0 its Fresnel term "MUST evaluate to 1.0
independently of the view or light direction" (KHR_materials_ior), so that the factor of that layer, smooth and over
black, is the reflectance of a grey mirror.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from raytruth.scenes.materials import Material
    from raytruth.scenes.values import Color


def gltf_material(name: str, material: Material) -> dict[str, Any]:
    """The material, on both sides of its surfaces. It must be one that is not refused."""
    diffuse = material.diffuse.reflectance if material.diffuse else (0.0, 0.0, 0.0)
    assert isinstance(diffuse, tuple)  # checkerboards are refused
    reflectance = material.mirror.reflectance[0] if material.mirror else 0.0
    extensions: dict[str, Any] = {"KHR_materials_specular": {"specularFactor": reflectance}}
    if material.mirror:
        extensions["KHR_materials_ior"] = {"ior": 0.0}
    written: dict[str, Any] = {
        "name": name,
        "doubleSided": True,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*diffuse, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.0 if material.mirror else 1.0,
        },
        "extensions": extensions,
    }
    if material.emission:
        radiance = material.emission.radiance
        assert isinstance(radiance, tuple)  # checkerboards are refused
        written["emissiveFactor"], strength = color_and_strength(radiance)
        extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    return written


def color_and_strength(color: Color) -> tuple[list[float], float]:
    """A colour up to 1, as glTF wants it, and what it must be multiplied by."""
    strength = max(color)
    return [component / strength if strength else 0.0 for component in color], strength
