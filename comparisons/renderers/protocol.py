"""The protocol that every renderer obeys, and which of its versions can be judged."""

from __future__ import annotations

import fnmatch
import shlex
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol, runtime_checkable

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
    """A renderer as the matrix sees it. It travels to other processes, and so can be pickled."""

    @property
    def name(self) -> str:
        """The fixed name, as in `mitsuba`, by which users choose it."""

    @property
    def integrators(self) -> tuple[Integrator, ...]:
        """The ways of rendering that it offers, each of which gets a cell for each scene."""

    @property
    def error_models(self) -> tuple[tuple[str, ErrorModel], ...]:
        """What its arithmetic may do to the result, each after the versions whose source that was derived from.

        Versions are a pattern of what `version` tells, in which `*` stands for anything; the first that fits holds.
        """

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


@runtime_checkable
class GivenRenderer(Renderer, Protocol):
    """A renderer that raytruth does not know by its name: its user gives it, a program or a finished picture."""

    @property
    def digest(self) -> str:
        """Of all that its result depends on besides our code."""

    def command(self, source: str) -> str:
        """What judges it again, on the scene that this names on the command line."""


def command_of(renderer: Renderer, source: str) -> str:
    """What judges a renderer again, on the scene that this names on the command line."""
    if isinstance(renderer, GivenRenderer):
        return renderer.command(source)
    return f"raytruth run {shlex.quote(source)} --renderer {renderer.name} --fresh"


def error_model_of(renderer: Renderer, version: str | None) -> ErrorModel | None:
    """The renderer's error model of this version; None for a version that none of its error models was derived from."""
    fitting = (model for pattern, model in renderer.error_models if fnmatch.fnmatchcase(version or "", pattern))
    return next(fitting, None)


def shown_error_model(renderer: Renderer, version: str | None) -> ErrorModel:
    """The renderer's error model of this version, or the last of all where none is."""
    return error_model_of(renderer, version) or renderer.error_models[-1][1]


def why_unavailable(renderer: Renderer, version: str | None) -> str | None:
    """Why a renderer that tells this version cannot be judged here, as what follows 'is'; None if it can."""
    if version is None:
        return f"not installed: {renderer.install}"
    if error_model_of(renderer, version) is None:
        derived = f"what it may deviate was derived from the source of {versions_in_words(renderer)}"
        return f"not judged in this version: {version} is installed, and {derived}; install that"
    return None


def versions_in_words(renderer: Renderer) -> str:
    """The versions that its error models were derived from."""
    return " or ".join("any version" if pattern == "*" else pattern for pattern, _ in renderer.error_models)
