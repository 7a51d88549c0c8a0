"""What the Mitsuba adapter and its child process tell each other: files in one folder."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

JOB_FILE = "job.json"
RAYS_FILE = "rays.npz"
"""Arrays `origins` and `directions`, float64 of shape (height, width, 3)."""
RESULT_FILE = "result.npz"
"""Arrays of Rendering and FirstHits by their names, and `version`."""


class Job(BaseModel):
    """One rendering; files are named relative to the folder the child runs in."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    variant: str
    scene_files: tuple[str, ...]
    """The same scene with a part of its light each; their images add up."""
    first_primitives: dict[str, int]
    """For each shape's id the number of its first primitive in the scene's numbering."""
    reversed_primitives: tuple[int, ...]
    """Primitives whose normal the exporter turned around."""
    batches: int
    """Batches of random samples along the given rays; 0: one deterministic image by Mitsuba's own sensor."""
    batch_samples: int
    traces_light: bool = False
    """Whether samples are light paths, so many for each pixel of the image and batch, that end on any pixel."""
