"""The rays of one pixel as a program prints them: a JSON object a line, which is untrusted."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from raytruth.comparisons.processes.isolation import LOG_FILE, run_isolated
from raytruth.comparisons.renderers.program.command import filled_command
from raytruth.scenes.exporters.formats import FORMATS
from raytruth.scenes.scene import LARGEST_DEPTH
from raytruth.scenes.validation import problems_of

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from raytruth.comparisons.renderers.program.adapter import ProgramRenderer
    from raytruth.scenes.scene import Scene

MEBIBYTE = 1 << 20
# A full binary tree of depth 11, as `raytruth explain` tells at most; of a line of all keys it is a megabyte.
MOST_RAYS = 4095
LOG_BYTES = MOST_RAYS * 512
# More mistakes than a person reads.
MOST_TOLD = 20

Number = Annotated[float, Field(allow_inf_nan=False, strict=True)]
Triple = tuple[Number, Number, Number]


class RayLine(BaseModel):
    """One ray of the tree; of what is left out nothing is compared."""

    model_config = ConfigDict(extra="ignore", frozen=True)

    path: Annotated[str, Field(pattern=rf"^[MRT]{{0,{LARGEST_DEPTH}}}$")]
    """How it came about from the camera's ray: M for a mirror, R and T for a dielectric's reflection and refraction."""
    origin: Triple | None = None
    direction: Triple | None = None
    """A unit vector."""
    primitive: Annotated[int, Field(strict=True, ge=-1)] | None = None
    """What it hits: spheres are counted first, then triangles, then planes, from 0; null or -1 for nothing."""
    distance: Number | None = None
    """From its origin to what it hits; null for nothing."""
    normal: Triple | None = None
    """The unit normal there, turned to the ray's origin."""
    local: Triple | None = None
    """What is seen there without reflection and refraction; the background where nothing is hit."""
    color: Triple | None = None
    """All that the ray brings back."""


class RayLinesError(Exception):
    """What a program printed is no ray tree; `problems` has one sentence for each thing to mend."""

    def __init__(self, problems: Sequence[str]) -> None:
        """Keeps the sentences; the exception's text has one on each line."""
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


def printed_rays(program: ProgramRenderer, scene: Scene, column: int, row: int, folder: Path) -> dict[str, RayLine]:
    """Run the program with `--trace COLUMN ROW` behind its own words, and read what it prints; rays by their paths.

    Raises RendererError where it fails, and RayLinesError where it prints something else.
    """
    declared = program.declaration
    scene_file = FORMATS[declared.reads].write(scene, folder)
    values = {
        "scene": scene_file.resolve(),
        "output": (folder / f"output.{declared.writes}").resolve(),
        "first_hits": (folder / "first-hits").resolve(),
        "width": scene.camera.width,
        "height": scene.camera.height,
        "depth": scene.max_depth,
        "seed": 1,
        "samples": 1,
        "folder": program.folder.resolve(),
    }
    words = filled_command(declared.command, program.folder, declared.environment, values)
    run_isolated(
        [*words, "--trace", str(column), str(row)],
        folder,
        seconds=declared.limits.seconds,
        memory_bytes=declared.limits.memory_mib * MEBIBYTE,
        file_bytes=declared.limits.output_mib * MEBIBYTE,
        output_bytes=LOG_BYTES,
        environment=declared.environment,
    )
    return ray_lines((folder / LOG_FILE).read_bytes().decode("utf-8", errors="replace"))


def ray_lines(printed: str) -> dict[str, RayLine]:
    """The rays in what a program printed, by their paths; lines that begin with no brace are its own business.

    Raises RayLinesError with every mistake.
    """
    rays: dict[str, RayLine] = {}
    problems: list[str] = []
    for number, line in enumerate(printed.split("\n"), start=1):
        if not line.startswith("{"):
            continue
        try:
            ray = RayLine.model_validate(_parsed(line))
        except ValidationError as error:
            problems += [f"line {number}: {where}: {told}" for where, told in problems_of(error, root=RayLine)]
            continue
        except ValueError as error:
            problems.append(f"line {number}: expected a JSON object, found a mistake: {error}.")
            continue
        if ray.path in rays:
            problems.append(f"line {number}: path: expected each path once, found '{ray.path}' a second time.")
        rays[ray.path] = ray
    if "" not in rays and not problems:
        problems.append(
            "expected a line of JSON for each ray, the camera's among them, found none: "
            "the program has to print them for `--trace COLUMN ROW` (docs/ray-trees.md)."
        )
    if len(rays) > MOST_RAYS:
        problems.append(f"expected at most {MOST_RAYS} rays, found more; lower max_depth of the scene.")
    if problems:
        raise RayLinesError(problems[:MOST_TOLD])
    return rays


def _parsed(line: str) -> Any:
    try:
        return json.loads(line)
    except RecursionError as error:
        raise ValueError("brackets are nested too deeply") from error
