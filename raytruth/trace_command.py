"""`raytruth trace`."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from raytruth.comparisons.grading.allowed_models import radiance_model
from raytruth.comparisons.grading.assignment_file import STARTING, AssignmentError, assignment_path, load_assignment
from raytruth.comparisons.grading.traces.divergence import compared
from raytruth.comparisons.grading.traces.ray_lines import RayLinesError, printed_rays
from raytruth.comparisons.matrix.quick_suite import small
from raytruth.comparisons.records.renderings import RendererError
from raytruth.errors import UsageError
from raytruth.options import AsJson, open_scene, parse_pixel
from raytruth.output import print_json, say
from raytruth.programs import the_program
from raytruth.reports.trace_text import comparison_text

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

FAILED = 1


def trace(
    scene: str,
    /,
    *command: str,
    pixel: Annotated[str, Parameter(allow_leading_hyphen=True)],
    quick: Annotated[bool, Parameter(negative="")] = False,
    assignment: str = STARTING,
    renderer_file: Path | None = None,
    as_json: AsJson = False,
) -> int:
    """Compare the ray tree that a program prints of a pixel with the right one, ray by ray to the first difference.

    Parameters
    ----------
    scene
        A scene of the library, or the path of a .json file.
    command
        After `--`: the program and its arguments as for `raytruth grade`. It is run with `--trace X Y` behind them.
    pixel
        X,Y: column from the left, row from the top, both from 0.
    quick
        Take the scene as small as `raytruth grade` and `raytruth run --quick` render it.
    assignment
        A ready assignment, or the path of a .toml file: what it allows of arithmetic is right here, too.
    renderer_file
        In place of a command: the program as this TOML file says that it is run.
    as_json
        Print one JSON document instead of text.
    """
    opened = small(open_scene(scene)) if quick else open_scene(scene)
    column, row = parse_pixel(pixel)
    _expect_in_image(opened, column, row)
    program = the_program("trace", command, renderer_file)
    try:
        models = load_assignment(assignment_path(assignment)).models
        with TemporaryDirectory(prefix="raytruth-") as folder:
            rays = printed_rays(program, opened, column, row, Path(folder))
    except (AssignmentError, RayLinesError) as error:
        raise UsageError(str(error)) from error
    except RendererError as error:
        say(f"The program failed: {error}.")
        return FAILED
    comparison = compared(opened, [radiance_model(model).in_scene(opened) for model in models], column, row, rays)
    if as_json:
        print_json(
            {"scene": opened.name, "pixel": [column, row], "rays": len(rays), **comparison.model_dump(mode="json")}
        )
    else:
        say(comparison_text(comparison))
    return 0 if comparison.divergence is None else FAILED


def _expect_in_image(scene: Scene, column: int, row: int) -> None:
    width, height = scene.camera.width, scene.camera.height
    if not (0 <= column < width and 0 <= row < height):
        raise UsageError(f"--pixel: expected 0,0 (top left) to {width - 1},{height - 1}, found {column},{row}.")
