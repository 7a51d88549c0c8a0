"""The local terms of the lighting equation in both conventions, for all pixels at once; shapes (height, width, 3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.renderers.closed_form.geometry import Array, Hits, dot
from raytruth.scenes.lights import GradientBackground, PointLight, PolynomialFalloff
from raytruth.scenes.materials import CheckerboardColor

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from raytruth.scenes.lights import Background, Light
    from raytruth.scenes.materials import Material, Specular, Texture
    from raytruth.scenes.scene import Scene


def background_radiance(background: Background, directions: Array) -> Array:
    """Constant, or between the colours of nadir and zenith, linear in the y of the unit direction."""
    if isinstance(background, GradientBackground):
        toward_zenith = (1 + directions[..., 1:2]) / 2
        return np.array(background.bottom) + toward_zenith * np.subtract(background.top, background.bottom)
    return np.broadcast_to(np.array(background.color), directions.shape)


def surface_radiance(
    scene: Scene, material: Material, hits: Hits, directions: Array, unobstructed: Sequence[NDArray[np.bool_]]
) -> Array:
    """What the surface sends to the eye: ka·Ia·Od + Le + Σ f_att·Lp·[kd·Od·(n·l) + ks·Os·highlight].

    Whitted 1980 (eq. 1 and 2) without its global terms. In the radiometric convention the diffuse reflectance is
    divided by π. `unobstructed` says for each light where nothing hides it.
    """
    radiance = np.zeros_like(directions)
    if material.emission is not None:
        radiance += texture_color(material.emission.radiance, hits.position)
    if material.ambient is not None:
        radiance += np.multiply(material.ambient.reflectance, scene.ambient_light)
    diffuse = np.zeros(3)
    if material.diffuse is not None:
        diffuse = texture_color(material.diffuse.reflectance, hits.position)
        if scene.convention == "radiometric":
            diffuse = diffuse / np.pi
    toward_viewer_normal = np.where(hits.is_front[..., None], hits.normal, -hits.normal)
    for light, is_free in zip(scene.lights, unobstructed, strict=True):
        toward_light, arriving = incident_light(light, hits.position)
        cosine = dot(toward_viewer_normal, toward_light)[..., None]
        reflected = diffuse * cosine
        if material.specular is not None:
            reflected = reflected + specular(material.specular, toward_viewer_normal, -directions, toward_light)
        radiance += np.where((cosine > 0) & is_free[..., None], arriving * reflected, 0.0)
    return radiance


def texture_color(texture: Texture, position: Array) -> Array:
    """A constant colour, or that of the square of a checkerboard in which a point's two coordinates lie."""
    if not isinstance(texture, CheckerboardColor):
        return np.array(texture)
    board = texture.checkerboard
    axes = ["xyz".index(axis) for axis in board.plane]
    square = np.floor((position[..., axes] - board.offset) / board.size)
    is_even = np.fmod(square.sum(axis=-1, keepdims=True), 2) == 0
    return np.where(is_even, board.even, board.odd)


def incident_light(light: Light, position: Array) -> tuple[Array, Array]:
    """The unit directions to a light, and f_att·Lp: what arrives per channel at a surface that faces it."""
    if not isinstance(light, PointLight):
        away = np.array(light.direction)
        return np.broadcast_to(-away / np.linalg.norm(away), position.shape), np.array(light.irradiance)
    to_light = np.array(light.position) - position
    distance = np.linalg.norm(to_light, axis=-1, keepdims=True)
    attenuation = np.ones_like(distance)
    if light.falloff == "inverse_square":
        attenuation = distance**-2.0
    elif isinstance(light.falloff, PolynomialFalloff):
        # Foley, van Dam, Feiner, Hughes 1990, eq. 16.8
        falloff = light.falloff
        divisor = falloff.constant + distance * (falloff.linear + distance * falloff.quadratic)
        attenuation = 1 / np.maximum(divisor, 1.0)
    return to_light / distance, attenuation * np.array(light.intensity)


def specular(term: Specular, normal: Array, toward_viewer: Array, toward_light: Array) -> Array:
    """ks·Os·(r·v)^n with r the light mirrored at the normal (Phong 1975), or ks·Os·(n·h)^n (Blinn 1977, eq. 3)."""
    if term.model == "phong":
        mirrored = 2 * dot(normal, toward_light)[..., None] * normal - toward_light
        cosine = dot(mirrored, toward_viewer)
    else:
        bisector = toward_light + toward_viewer
        cosine = dot(normal, bisector) / np.linalg.norm(bisector, axis=-1)
    return np.array(term.reflectance) * np.maximum(cosine, 0.0)[..., None] ** term.exponent
