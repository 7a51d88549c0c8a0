"""A renderer that does what a test tells it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.records.renderings import Rendering
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.rendering import render
from raytruth.scenes.light_paths import WHITTED
from raytruth.scenes.requirements import used_materials

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rays
    from raytruth.scenes.scene import Scene


def truthful(scene: Scene, folder: Path) -> Rendering:
    """The truth itself, at once."""
    (folder / "log.txt").write_text("Nothing to say.\n", encoding="utf-8")
    return Rendering(np.asarray(render(scene, FLOAT), dtype=np.float32), seconds=0.5)


@dataclass
class Pretender:
    """Obeys the protocol Renderer; counts how often it is tried and asked to render."""

    answer: Callable[[Scene, Path], Rendering] = truthful
    name: str = "pretender"
    installed: str | None = "pretender 1"
    refusal: str | None = None
    integrators: tuple[Integrator, ...] = (Integrator("whitted", WHITTED, has_depth=True),)
    error_model: ErrorModel = field(default_factory=lambda: ErrorModel("float64", precision_bits=51))
    derived_for: str = "pretender *"
    install: str = "cannot be installed"
    calls: int = 0
    trials: int = 0

    @property
    def error_models(self) -> tuple[tuple[str, ErrorModel], ...]:
        """The one of the versions told."""
        return ((self.derived_for, self.error_model),)

    def version(self) -> str | None:
        """As told."""
        self.trials += 1
        return self.installed

    def refuses(self, scene: Scene) -> str | None:  # noqa: ARG002 - the protocol's signature
        """As told."""
        return self.refusal

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Where there is glass."""
        return any(material.dielectric for material in used_materials(scene))

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """What the answer gives."""
        self.calls += 1
        return self.answer(scene, folder)
