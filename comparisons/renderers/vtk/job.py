"""What the VTK adapter and its child process tell each other: files in one folder."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

JOB_FILE = "job.json"
TASK_FILE = "task.npz"
"""The arrays `triangles` of shape (n, 3, 3), in float64, and `surface` of shape (n,): each one's place in the job."""
RESULT_FILE = "result.npz"
"""`seconds` and `version`; of first hits arrays `primitive` and `depth` of shape (height, width), `drawn_normal` of
shape (height, width, 3) and `normals` of shape (n, 3); of light the array `image` of shape (height, width, 3)."""

Vector = tuple[float, float, float]


class Surface(BaseModel):
    """The colours of a material, by which VTK multiplies the light that arrives."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    ambient: Vector
    """What leaves it without any light."""
    diffuse: Vector
    specular: Vector
    exponent: float


class Lamp(BaseModel):
    """A point light or a directional one, as VTK is told of it."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    position: Vector | None
    """None for parallel light."""
    direction: Vector
    """The direction in which parallel light travels."""
    color: Vector
    attenuation: Vector
    """The divisor's constant, linear and quadratic coefficient."""


class Job(BaseModel):
    """What one picture of all triangles needs: the camera, its size in pixels, and the lamps."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    draws: Literal["first hits", "light"] = "first hits"
    width: int
    height: int
    position: Vector
    look_at: Vector
    up: Vector
    view_angle: float | None = None
    """Vertical, in degrees; None: parallel rays."""
    view_height: float = 1.0
    """What is seen of it by parallel rays."""
    near: float
    """Depths along the forward direction of what is drawn."""
    far: float
    background: Vector = (0.0, 0.0, 0.0)
    surfaces: tuple[Surface, ...] = ()
    lamps: tuple[Lamp, ...] = ()
