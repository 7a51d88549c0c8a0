"""The protocol that every renderer obeys."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.records.renderings import Rays, Rendering
    from raytruth.scenes.scene import Scene


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
