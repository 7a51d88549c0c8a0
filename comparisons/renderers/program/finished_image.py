"""A picture that somebody has already, as a renderer that gives it and nothing else."""

from __future__ import annotations

import hashlib
import re
import shlex
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.records.image_files import ImageError
from raytruth.comparisons.records.renderings import RendererError, Rendering
from raytruth.comparisons.renderers.program.declaration import Arithmetic, Declaration
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration, output_model_of
from raytruth.comparisons.renderers.program.output_images import FORMATS, read_output, stored_numbers
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.light_paths import WHITTED

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.records.renderings import Rays
    from raytruth.comparisons.renderers.program.output_images import Format
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class FinishedImage:
    """A picture in a file, obeying the protocol GivenRenderer."""

    name: str
    path: Path
    declaration: Declaration
    options: str
    """What `raytruth judge` is told of it besides its path and the scene, as a shell takes it."""

    integrators = (Integrator("whitted", WHITTED, has_depth=True),)
    install = "a finished picture"

    @cached_property
    def error_models(self) -> tuple[tuple[str, ErrorModel], ...]:
        """One, as declared."""
        return (("*", error_model_of_declaration(self.declaration)),)

    @cached_property
    def digest(self) -> str:
        """Of the file and of what is declared of it."""
        digest = hashlib.sha256(self.declaration.model_dump_json().encode())
        digest.update(self.path.read_bytes() if self.path.is_file() else b"")
        return digest.hexdigest()[:16]

    def version(self) -> str | None:
        """It has none but its digest."""
        return f"picture {self.digest[:8]}"

    def refuses(self, scene: Scene) -> str | None:
        """Why its conventions cannot be undone; else nothing, since it is there."""
        return self.declaration.conventions.refuses(scene, 0)

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never: of one picture nobody knows how it scatters."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """The picture as it is. Raises RendererError where it cannot be read, or is not as declared."""
        declared, size = self.declaration, (scene.camera.height, scene.camera.width)
        try:
            image = read_output(self.path, declared, size, output_model_of(declared))
        except (ImageError, OSError) as error:
            raise RendererError(str(error)) from error
        return Rendering(np.ascontiguousarray(image), 0.0)

    def command(self, source: str) -> str:
        """What judges it again."""
        return f"raytruth judge {shlex.quote(str(self.path))} --scene {shlex.quote(source)} {self.options}".rstrip()


def declared_by_itself(path: Path, bits: int | None, *, is_srgb: bool) -> Declaration:
    """The declaration of a picture by its ending and its header. Raises ImageError for what is no picture."""
    form: Format | None = next((known for known in FORMATS if path.suffix.lower() == f".{known}"), None)
    if form is None:
        raise ImageError(f"its name does not end in {', '.join(f'.{known}' for known in FORMATS)}")
    numbers = None if form == "hdr" else stored_numbers(path)
    if numbers is not None and numbers not in FORMATS[form][1]:
        raise ImageError(f"it holds {numbers} numbers, which no {form} does")
    return Declaration(
        name="picture",
        command=("{scene}", "{output}"),
        writes=form,
        numbers=numbers,
        colours="srgb" if is_srgb else "linear",
        arithmetic=Arithmetic(bits=bits),
    )


def column_names(paths: tuple[Path, ...]) -> list[str]:
    """For each picture the name of its column: that of its file as far as a column may have it, and each only once."""
    names: list[str] = []
    for path in paths:
        plain = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-")[:40] or "picture"
        taken = sum(name == plain or name.startswith(f"{plain}-") for name in names)
        names.append(f"{plain}-{taken + 1}" if taken else plain)
    return names
