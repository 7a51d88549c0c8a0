"""What the Embree adapter and its child process tell each other: files in one folder."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

JOB_FILE = "job.json"
TASK_FILE = "task.npz"
"""Arrays `origins` and `directions` of shape (height, width, 3), and `triangles` of shape (n, 3, 3), in float64."""
RESULT_FILE = "result.npz"
"""Arrays of FirstHits by their names, `lit` of shape (lights, height, width), `seconds` and `version`."""


class Light(BaseModel):
    """A light, as shadow rays need to know it."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    is_near: bool
    vector: tuple[float, float, float]
    """The light's position if it is near, else the direction to it."""


class Job(BaseModel):
    """What the worker has to find: first hits, and whether each hit sees each light."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    robust: bool
    lights: tuple[Light, ...]
    offset: float
    """Shadow rays start at p + n·offset·(1 + max|p|), n the normal on the viewer's side."""
