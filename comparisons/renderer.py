"""The protocol that every renderer obeys, and what it gives back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from pathlib import Path

    from comparisons.error_model import ErrorModel
    from scenes.scene import Scene

Image = NDArray[np.float32]
"""Linear RGB, shape (height, width, 3), row 0 on top."""


class RendererError(Exception):
    """A renderer crashed, hung, ran out of memory, or wrote what cannot be read; the message is one sentence."""


@dataclass(frozen=True)
class Rays:
    """Primary rays, one a pixel: arrays of shape (height, width, 3); directions are unit vectors."""

    origins: NDArray[np.float64]
    directions: NDArray[np.float64]


@dataclass(frozen=True)
class FirstHits:
    """What the primary rays meet: shape (height, width) or (height, width, 3)."""

    depth: NDArray[np.float64]
    """Distance along the unit ray; infinity where nothing is hit."""
    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    """The unit geometric normal as the shape defines it: outward, not turned to the viewer."""
    primitive: NDArray[np.int64]
    """Spheres first, then triangles, in the order of the scene's objects; -1: nothing."""


@dataclass(frozen=True)
class Rendering:
    """What one integrator gives. A stochastic renderer gives the mean over all samples and the batch means."""

    image: Image | None
    """None, with first hits, from an integrator that gives first hits only."""
    seconds: float
    first_hits: FirstHits | None = None
    samples: int = 1
    """Of each pixel; of an integrator that follows light paths, the number of these."""
    batch_means: NDArray[np.float32] | None = None
    """Shape (batches, height, width, 3): means over equally many samples with independent seeds."""


@dataclass(frozen=True)
class Integrator:
    """A way of rendering that a renderer offers, with the light paths it sums (scenes/light_paths.py)."""

    name: str
    light_paths: str
    """A regular expression over Heckbert's letters; `{depth}` stands for a limit on the number of bounces."""
    has_depth: bool = False
    gives: Literal["image", "image and first hits", "first hits"] = "image"
    """First hits alone need no light: they can be compared on every scene, whatever the light paths."""
    follows: Literal["camera rays", "light paths"] = "camera rays"
    """Light paths, traced forward from the lights, give the mean over a pixel's area, not the value at its centre."""


class Renderer(Protocol):
    """A renderer as the matrix sees it."""

    @property
    def name(self) -> str:
        """The fixed name, as in `mitsuba`."""

    @property
    def integrators(self) -> tuple[Integrator, ...]:
        """What it can compute."""

    @property
    def error_model(self) -> ErrorModel:
        """What its arithmetic may do to the result."""

    @property
    def install(self) -> str:
        """One line that says how to install it."""

    def version(self) -> str | None:
        """Its version, or None where it cannot run here."""

    def refuses(self, scene: Scene) -> str | None:
        """Why it cannot express this scene, in one sentence that follows 'because'; None if it can."""

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:
        """Whether its result on this scene depends on random numbers."""

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:
        """Render in a process of its own; its files and `log.txt` stay in `folder`. Raises RendererError."""
