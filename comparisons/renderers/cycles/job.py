"""What the Cycles adapter and its child process tell each other: files in one folder."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

JOB_FILE = "job.json"
RESULT_FILE = "result.npz"
"""Arrays `image` of shape (height, width, 3), `seconds` and `version`, and `batch_means` where there are batches."""

Triple = tuple[float, float, float]


class JobPart(BaseModel):
    """Immutable, and without keys that it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)


class Texture(JobPart):
    """A colour, or squares of two colours in the plane of two axes.

    It is `even` where the sum of both whole numbers of squares, rounded down, is even.
    """

    even: Triple
    odd: Triple | None = None
    """None: `even` everywhere."""
    size: float = 1.0
    axes: tuple[int, int] = (0, 2)
    offset: tuple[float, float] = (0.0, 0.0)


class Closure(JobPart):
    """One term of a material."""

    kind: Literal["diffuse", "mirror", "glass", "emission"]
    color: Texture
    index: float = 1.0
    """The index of refraction, relative to the medium outside."""


class Mesh(JobPart):
    """Triangles that share vertices; each is flat, with one normal."""

    vertices: tuple[Triple, ...]
    faces: tuple[tuple[int, int, int], ...]
    material: int


class Ball(JobPart):
    """A sphere: what Cycles calls a point, and intersects as a true sphere."""

    center: Triple
    radius: float
    material: int


class Lamp(JobPart):
    """A light without extent."""

    kind: Literal["POINT", "SUN"]
    vector: Triple
    """The position of a point, the unit direction in which a sun shines."""
    strength: Triple
    """Radiant intensity of a point, irradiance of a sun."""


class Camera(JobPart):
    """Where rays start."""

    axes: tuple[Triple, Triple, Triple]
    """Right, up and backward: unit vectors."""
    position: Triple
    tangent: float | None
    """The tangent of half the vertical field of view; None: rays are parallel."""
    view_height: float = 1.0
    """The height of what parallel rays see, in units of the scene."""
    far: float
    """The distance of a far plane beyond all that is seen."""
    width: int
    height: int


class Part(JobPart):
    """A share of the scene's light; the images of all parts add up."""

    name: str
    materials: tuple[tuple[Closure, ...], ...]
    """The terms that count here; a material without any is black."""
    lamps: tuple[Lamp, ...] = ()
    background: tuple[Triple, Triple] | None = None
    """Radiance straight down and straight up, linear in the y of the direction between."""
    bounces: int


class Job(JobPart):
    """One rendering: one sample a pixel of each part, through the pixel's centre; or many, in batches."""

    camera: Camera
    objects: tuple[Mesh | Ball, ...]
    parts: tuple[Part, ...]
    batches: int
    """Batches of random samples; 0: one image, since nothing is random."""
    batch_samples: int
