"""What the VTK adapter and its child process tell each other: files in one folder."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

JOB_FILE = "job.json"
TASK_FILE = "task.npz"
"""The array `triangles` of shape (n, 3, 3), in float64."""
RESULT_FILE = "result.npz"
"""Arrays `primitive` and `depth` of shape (height, width), `normals` of shape (n, 3), `seconds` and `version`."""

Vector = tuple[float, float, float]


class Job(BaseModel):
    """One picture of all triangles."""

    model_config = ConfigDict(extra="forbid", frozen=True)

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
