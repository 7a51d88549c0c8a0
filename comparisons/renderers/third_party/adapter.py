"""A renderer that another package brings."""

from __future__ import annotations

import hashlib
import inspect
import shlex
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.records.renderings import Rays, Rendering
    from raytruth.comparisons.renderers.protocol import Integrator, Renderer
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class ThirdPartyRenderer:
    """The package's own renderer and where it comes from, obeying the protocol GivenRenderer."""

    renderer: Renderer
    origin: str
    """The package's name and version."""

    @property
    def name(self) -> str:
        """As the package calls it."""
        return self.renderer.name

    @property
    def integrators(self) -> tuple[Integrator, ...]:
        """As the package has them."""
        return self.renderer.integrators

    @property
    def error_models(self) -> tuple[tuple[str, ErrorModel], ...]:
        """As the package declares them."""
        return self.renderer.error_models

    @property
    def install(self) -> str:
        """As the package says."""
        return self.renderer.install

    def version(self) -> str | None:
        """As the package finds it."""
        return self.renderer.version()

    def refuses(self, scene: Scene) -> str | None:
        """As the package has it."""
        return self.renderer.refuses(scene)

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:
        """As the package has it."""
        return self.renderer.is_stochastic(scene, integrator)

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:
        """As the package does."""
        return self.renderer.render(scene, integrator, depth, rays, folder)

    @cached_property
    def digest(self) -> str:
        """Of the package's name and version, and of the file of the renderer's class."""
        digest = hashlib.sha256(f"{self.origin}\n".encode())
        digest.update(Path(inspect.getfile(type(self.renderer))).read_bytes())
        return digest.hexdigest()[:16]

    def command(self, source: str) -> str:
        """What judges it again on a scene: it is chosen by its name, as ours are."""
        return f"raytruth run {shlex.quote(source)} --renderer {self.name} --fresh"
