"""What an explanation of a pixel holds: plain data, as JSON too.

Lengths are in scene units, colours linear RGB: radiance in W/(m²·sr) in the radiometric convention, without a unit in
the classical one. None stands for a value that does not exist, such as the hit of a ray that meets nothing.
"""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

Vector = tuple[float, float, float]
RayKind = Literal["camera", "reflected", "transmitted"]
Falloff = Literal["none", "inverse_square", "polynomial"]


class Record(BaseModel):
    """A part of an explanation: immutable, and without keys that it does not know."""

    # JSON has no numbers for infinity and not-a-number: they are written as strings.
    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="strings")


class Hit(Record):
    """Where a ray ends on a surface."""

    distance: float
    primitive: int
    """Spheres first, then triangles, then planes, in the order of the scene's objects."""
    object_index: int
    """Which of the scene's `objects`."""
    material: str
    point: Vector
    normal: Vector
    """The unit normal, turned to the side from which the ray comes."""
    entering: bool
    """Whether the ray comes from the side to which the shape's own normal points."""


class LightTerm(Record):
    """What one light adds: (diffuse·(n·l) + specular_reflectance·highlight)·arriving, unless it is hidden."""

    light: int
    """Which of the scene's `lights`."""
    kind: Literal["point", "directional"]
    to_light: Vector
    """From the hit point to the light: the whole way to a point light, of any length for a directional one."""
    falloff: Falloff | None
    attenuation: float | None
    """The part of a point light's intensity that arrives at this distance."""
    arriving: Vector
    cosine: float
    """n·l; the light is behind the surface where it is not positive."""
    shadowed: bool | None
    """None where the light is behind the surface, so that nobody asked."""
    occluder: int | None
    """A primitive that stands in the way; not always the nearest one."""
    occluder_object: int | None
    diffuse: Vector | None
    """kd·Od, or ρ/π in the radiometric convention."""
    highlight: float | None
    """Phong's (r·v)^n or Blinn's (n·h)^n."""
    specular_reflectance: Vector | None
    specular_model: Literal["phong", "blinn"] | None
    radiance: Vector


class DielectricTerm(Record):
    """How a dielectric surface splits the ray, with refraction.py's names."""

    index_ratio: float
    """η: the index of refraction beyond the surface over that before it."""
    cosine: float
    """c, of the angle of incidence."""
    discriminant: float
    """g² = η² − 1 + c²: negative for total internal reflection."""
    total_internal_reflection: bool
    fresnel_reflectance: float | None
    """None for total internal reflection and for the classical constants ks and kt."""
    reflected_weight: Vector
    transmitted_weight: Vector | None


class TracedRay(Record):
    """One ray of the tree, and what it brings back."""

    number: int
    parent: int | None
    kind: RayKind
    origin: Vector
    direction: Vector
    weight: Vector
    """The product of all reflectances and transmittances on the way from the camera to the ray's origin."""
    starts_on: int | None
    """The primitive that it leaves."""
    medium: str | None
    """The dielectric material that it travels in; None for empty space."""
    depth_left: int
    """How many more reflections and refractions may follow."""
    hit: Hit | None
    background: Vector | None
    """What a ray sees that meets nothing."""
    medium_transmittance: Vector | None
    """exp(−σ·d), which multiplies the weight, in an absorbing medium."""
    emission: Vector | None
    ambient: Vector | None
    lights: tuple[LightTerm, ...]
    local: Vector | None
    """Emission, ambient and all lights together, at the hit."""
    mirror_reflectance: Vector | None
    """The mirror's reflectance, whether or not the depth allows one more ray."""
    dielectric: DielectricTerm | None
    """None where the depth is exhausted, too."""
    contribution: Vector
    """Weight times medium transmittance times what is seen at the ray's end."""


class Explanation(Record):
    """The whole ray tree of a pixel; its rays in the order in which they were traced, each after its parent."""

    scene: str
    x: int
    y: int
    convention: Literal["whitted", "radiometric"]
    sum: Vector
    """The sum of all contributions, in the order of the rays: the pixel's colour."""
    rays: tuple[TracedRay, ...]
