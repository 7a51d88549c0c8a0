"""What may be asked, and with which keys: one class a question, each told in a sentence."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from raytruth.comparisons.renderers.program.declaration import Arithmetic, Declaration, Formulas
from raytruth.scenes.camera import Camera
from raytruth.scenes.lights import Light
from raytruth.scenes.materials import Index, Material
from raytruth.scenes.values import Color, Direction, Part, Positive, Vector

# As in the ready assignments: for another order of operations, fused ones, and functions of a mathematical library.
USUAL_SLACK_BITS = 2
# With 16 bits of float32's 24 left out, 8 are left, the fewest that a declaration may have.
MOST_SLACK_BITS = 16
# A question is one step; a scene with more lights is asked for light by light.
MOST_LIGHTS = 16
# An id is there to be found again.
LONGEST_ID = 200

UNIT = "Of any length but zero; it is made a unit vector."


class Asked(Part):
    """What every question may state."""

    id: Annotated[str, Field(max_length=LONGEST_ID)] | Annotated[int, Field(strict=True)] | None = Field(
        None, description="Anything that the answer repeats."
    )
    slack_bits: Annotated[int, Field(strict=True, ge=0, le=MOST_SLACK_BITS)] = Field(
        USUAL_SLACK_BITS, description="Bits of float32 and of float64 that are left for another order of operations."
    )
    formulas: Formulas = Field(
        Formulas(), description="By which formulas the program computes, as in a file that declares a program."
    )


class _Ray(Asked):
    origin: Vector = Field(description="Where the ray starts.")
    direction: Direction = Field(description="Of any length but zero; distances are in units of it.")


class IntersectSphere(_Ray):
    """Where a ray meets a sphere first."""

    ask: Literal["intersect_sphere"]
    center: Vector
    radius: Positive


class IntersectTriangle(_Ray):
    """Where a ray meets a triangle; its normal is on the side from which a, b, c run counterclockwise."""

    ask: Literal["intersect_triangle"]
    a: Vector
    b: Vector
    c: Vector


class IntersectPlane(_Ray):
    """Where a ray meets an infinite plane."""

    ask: Literal["intersect_plane"]
    point: Vector
    normal: Direction


class IntersectBox(_Ray):
    """Where a ray enters and leaves an axis-aligned box; it enters at 0 where it starts inside."""

    ask: Literal["intersect_box"]
    low: Vector
    high: Vector

    @model_validator(mode="after")
    def _is_a_box(self) -> IntersectBox:
        if any(low > high for low, high in zip(self.low, self.high, strict=True)):
            raise ValueError("expected no coordinate of low above that of high")
        return self


class Reflect(Asked):
    """Into which direction a mirror sends a ray; the length of the direction is kept."""

    ask: Literal["reflect"]
    direction: Direction
    normal: Direction = Field(description=f"On either side. {UNIT}")


class Refract(Asked):
    """Into which directions a smooth dielectric sends a ray, and how it splits light by Fresnel's equations."""

    ask: Literal["refract"]
    direction: Direction = Field(description=UNIT)
    normal: Direction = Field(description=f"On either side. {UNIT}")
    index_from: Index = Field(description="Index of refraction of the medium that the ray comes from.")
    index_to: Index = Field(description="Index of refraction of the medium beyond the surface.")


class Fresnel(Asked):
    """Which part of unpolarised light a smooth dielectric reflects."""

    ask: Literal["fresnel"]
    cosine: Annotated[float, Field(strict=True, ge=0, le=1)] = Field(description="Of the angle of incidence.")
    index_from: Index = Field(description="Index of refraction of the medium that the light comes from.")
    index_to: Index = Field(description="Index of refraction of the medium beyond the surface.")


class Shade(Asked):
    """What a surface sends back along a ray by itself: emission, ambient, diffuse and specular terms, no shadows."""

    ask: Literal["shade"]
    convention: Literal["whitted", "radiometric"]
    point: Vector = Field(description="Where the ray meets the surface.")
    normal: Direction = Field(description=f"On either side. {UNIT}")
    direction: Direction = Field(description=f"Of the ray, from the eye to the surface. {UNIT}")
    material: Material = Field(description="As in a scene file.")
    lights: Annotated[tuple[Light, ...], Field(max_length=MOST_LIGHTS)] = Field((), description="As in a scene file.")
    ambient_light: Color = Field((0.0, 0.0, 0.0), description="As in a scene file.")


class PrimaryRay(Asked):
    """The ray through the centre of a pixel; its direction is a unit vector."""

    ask: Literal["primary_ray"]
    camera: Camera = Field(description="As in a scene file.")
    pixel: tuple[Annotated[int, Field(strict=True, ge=0)], Annotated[int, Field(strict=True, ge=0)]] = Field(
        description="Column from the left and row from the top, from 0."
    )

    @model_validator(mode="after")
    def _is_in_the_image(self) -> PrimaryRay:
        column, row = self.pixel
        if column >= self.camera.width or row >= self.camera.height:
            size = f"{self.camera.width} x {self.camera.height}"
            raise ValueError(f"expected a pixel of the image, which is {size}, found {column},{row}")
        return self


Question = (
    IntersectSphere
    | IntersectTriangle
    | IntersectPlane
    | IntersectBox
    | Reflect
    | Refract
    | Fresnel
    | Shade
    | PrimaryRay
)
QUESTIONS: dict[str, type[Question]] = {
    "intersect_sphere": IntersectSphere,
    "intersect_triangle": IntersectTriangle,
    "intersect_plane": IntersectPlane,
    "intersect_box": IntersectBox,
    "reflect": Reflect,
    "refract": Refract,
    "fresnel": Fresnel,
    "shade": Shade,
    "primary_ray": PrimaryRay,
}
"""By what stands under `ask`."""


def declaration_of(question: Question, precision: Literal["float32", "float64"]) -> Declaration:
    """What a program would declare that computes as the question says; its name and command do not matter."""
    return Declaration(
        name="asked",
        command=("{scene}", "{output}"),
        arithmetic=Arithmetic(precision=precision, slack_bits=question.slack_bits),
        formulas=question.formulas,
    )
