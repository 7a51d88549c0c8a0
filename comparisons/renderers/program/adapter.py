"""Any program as a renderer: a command that reads a scene file and writes a picture, as its user declares it."""

from __future__ import annotations

import hashlib
import shlex
import shutil
import time
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np

from raytruth.comparisons.processes.isolation import LOG_FILE, end_of_log, run_isolated
from raytruth.comparisons.records.image_files import ImageError
from raytruth.comparisons.records.renderings import FirstHits, RendererError, Rendering
from raytruth.comparisons.renderers.program.command import counted_files, filled_command
from raytruth.comparisons.renderers.program.declared_model import error_model_of_declaration, output_model_of
from raytruth.comparisons.renderers.program.first_hit_files import FIRST_HITS_FILE, read_first_hits
from raytruth.comparisons.renderers.program.output_images import read_output
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.exporters.formats import FORMATS
from raytruth.scenes.light_paths import WHITTED
from raytruth.scenes.requirements import required_features

if TYPE_CHECKING:
    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.records.renderings import Image, Rays
    from raytruth.comparisons.renderers.program.declaration import Declaration
    from raytruth.scenes.scene import Scene

MEBIBYTE = 1 << 20
# Asking for a version computes nothing.
VERSION_SECONDS = 20.0
# As much of it as a report shows on a line.
LONGEST_VERSION = 60
# Where the program runs, below the folder of its cell: so it cannot remove its own log by chance.
WORK_FOLDER = "program"


@dataclass(frozen=True)
class ProgramRenderer:
    """A user's program, obeying the protocol GivenRenderer."""

    declaration: Declaration
    folder: Path
    """Where the paths in the declaration start."""
    chosen_by: str
    """What chooses it on the command line: an option with its value, as a shell takes it."""

    @property
    def name(self) -> str:
        """As its user calls it."""
        return self.declaration.name

    @property
    def integrators(self) -> tuple[Integrator, ...]:
        """One: the specification's light paths."""
        hits = self.declaration.uses("first_hits")
        return (Integrator("whitted", WHITTED, has_depth=True, gives="image and first hits" if hits else "image"),)

    @cached_property
    def error_models(self) -> tuple[tuple[str, ErrorModel], ...]:
        """One, as declared, whatever the version."""
        return (("*", error_model_of_declaration(self.declaration)),)

    @property
    def install(self) -> str:
        """It is the user's own; where it cannot run, its version command has failed."""
        told = f"given by {self.chosen_by}"
        return f"{told}; its version command must succeed" if self.declaration.version else told

    @cached_property
    def digest(self) -> str:
        """Of the declaration, and of the program's files: it changes when the program is built anew."""
        declared = self.declaration
        digest = hashlib.sha256(declared.model_dump_json().encode())
        for path in counted_files(declared.command, self.folder, declared.environment, declared.files):
            digest.update(f"\n{path}\n".encode(errors="surrogateescape"))
            try:
                with path.open("rb") as file:
                    digest.update(hashlib.file_digest(file, "sha256").digest())
            except OSError:  # as where there is none
                continue
        return digest.hexdigest()[:16]

    def version(self) -> str | None:
        """What its version command prints first, and a digest of its files; None where that command fails."""
        build = f"build {self.digest[:8]}"
        if not self.declaration.version:
            return build
        with TemporaryDirectory(prefix="raytruth-") as name:
            try:
                self._run(self.declaration.version, Path(name), VERSION_SECONDS, {"folder": self.folder.resolve()})
            except RendererError:
                return None
            lines = (Path(name) / LOG_FILE).read_text(encoding="utf-8", errors="replace").split("\n")
        told = "".join(character for character in lines[0] if character.isprintable()).strip()
        return f"{told[:LONGEST_VERSION]}, {build}" if told else build

    def refuses(self, scene: Scene) -> str | None:
        """Why it cannot express this scene: by its own declaration, or since its format cannot."""
        required = {feature.lower() for feature in required_features(scene)}
        refused = sorted(required & set(self.declaration.scenes.refuses))
        if refused:
            return f"{self.name} is declared to refuse what the scene requires: {', '.join(refused)}"
        conventions, samples = self.declaration.conventions, self.declaration.sampling.samples
        by_declaration = conventions.refuses(scene, samples) or self.declaration.model.refuses(scene)
        return by_declaration or FORMATS[self.declaration.reads].refuses(conventions.handed(scene))

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """On all scenes, if it draws samples."""
        return self.declaration.sampling.samples > 0

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - the protocol's signature
        """Run the program in a folder of its own, once or for each batch; its log and its picture stay in `folder`.

        The time is that of the whole process. Raises RendererError.
        """
        work = folder / WORK_FOLDER
        work.mkdir()
        try:
            handed = self.declaration.conventions.handed(scene.model_copy(update={"max_depth": depth}))
            return self._rendering(handed, work)
        except OSError as error:
            raise RendererError(f"its folder is not as it was made: {error.strerror}") from error
        finally:
            _keep_only(folder, work, (LOG_FILE, self._output))

    def command(self, source: str) -> str:
        """What runs it again on a scene."""
        return f"raytruth run {shlex.quote(source)} {self.chosen_by} --fresh"

    @property
    def _output(self) -> str:
        return f"output.{self.declaration.writes}"

    def _rendering(self, scene: Scene, work: Path) -> Rendering:
        """The mean of all batches; where there are none, the one picture."""
        sampling = self.declaration.sampling
        scene_file = FORMATS[self.declaration.reads].write(scene, work)
        start = time.perf_counter()
        seeds = range(1, sampling.batches + 1) if sampling.samples else range(1, 2)
        try:
            pictures = [self._picture(scene, scene_file, seed, work) for seed in seeds]
            seconds = time.perf_counter() - start
            hits = self._first_hits(scene, work)
        except ImageError as error:
            raise RendererError(f"{error}; {end_of_log(work / LOG_FILE)}") from error
        if not sampling.samples:
            return Rendering(pictures[0], seconds, hits)
        batches = np.stack(pictures)
        mean = batches.mean(axis=0, dtype=np.float64).astype(np.float32)
        return Rendering(mean, seconds, hits, samples=sampling.samples * sampling.batches, batch_means=batches)

    def _picture(self, scene: Scene, scene_file: Path, seed: int, work: Path) -> Image:
        """One run of the program; the picture of an earlier one must not be taken for this."""
        output = work / self._output
        output.unlink(missing_ok=True)
        values = {
            "scene": scene_file.resolve(),
            "output": output.resolve(),
            "first_hits": (work / FIRST_HITS_FILE).resolve(),
            "width": scene.camera.width,
            "height": scene.camera.height,
            "depth": scene.max_depth,
            "seed": seed,
            "samples": max(1, self.declaration.sampling.samples),
            "folder": self.folder.resolve(),
        }
        self._run(self.declaration.command, work, self.declaration.limits.seconds, values)
        size = (scene.camera.height, scene.camera.width)
        model = output_model_of(self.declaration)
        return np.ascontiguousarray(read_output(output, self.declaration, size, model))

    def _first_hits(self, scene: Scene, work: Path) -> FirstHits | None:
        """Those of the last run, if the command asks for them."""
        if not self.declaration.uses("first_hits"):
            return None
        hits = read_first_hits(work / FIRST_HITS_FILE, (scene.camera.height, scene.camera.width))
        return FirstHits(**{name: self.declaration.conventions.undone(values) for name, values in vars(hits).items()})

    def _run(self, command: tuple[str, ...], work: Path, seconds: float, values: dict[str, object]) -> None:
        declared = self.declaration
        run_isolated(
            filled_command(command, self.folder, declared.environment, values),
            work,
            seconds=seconds,
            memory_bytes=declared.limits.memory_mib * MEBIBYTE,
            file_bytes=declared.limits.output_mib * MEBIBYTE,
            environment=declared.environment,
        )


def _keep_only(folder: Path, work: Path, names: tuple[str, ...]) -> None:
    """Leave in the folder these files of the work folder and nothing else, also nothing that was put beside it."""
    kept = [name for name in names if (work / name).is_file() and not (work / name).is_symlink()]
    for path in folder.iterdir():
        if path != work:
            shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()
    for name in kept:
        (work / name).replace(folder / name)
    shutil.rmtree(work, ignore_errors=True)
