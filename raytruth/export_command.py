"""`raytruth scenes export`: a scene as files of other programs."""

from __future__ import annotations

import shlex
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from raytruth.errors import UsageError
from raytruth.options import AsJson, open_scene
from raytruth.output import print_json, say, tell
from raytruth.scenes.exporters.formats import FORMATS

if TYPE_CHECKING:
    from raytruth.scenes.exporters.formats import Format
    from raytruth.scenes.scene import Scene


def export(
    scene: str,
    /,
    *,
    to: Literal["mitsuba", "povray", "pbrt", "obj", "gltf", "json"],
    out: Annotated[Path | None, Parameter(name=["--out", "-o"], show_default=False)] = None,
    as_json: AsJson = False,
) -> None:
    """Write a scene as files of another program.

    What the format cannot say is refused where the picture would be wrong, and told where it is left out.

    Example: `raytruth scenes export cornell-box --to mitsuba --out cornell`

    Parameters
    ----------
    scene
        A scene of the library, or the path of a .json file.
    to
        The format; json is a scene file of raytruth's own that holds its meshes.
    out
        The folder for the files, by default SCENE-FORMAT; it is made if only itself is missing.
    as_json
        Print one JSON document instead of text.
    """
    opened = open_scene(scene)
    form = FORMATS[to]
    reason = form.refuses(opened)
    if reason is not None:
        raise UsageError(f"{opened.name} cannot be written {form.purpose}, because {reason}.")
    folder = out or Path(f"{opened.name}-{to}")
    if not folder.parent.is_dir():
        raise UsageError(f"--out: there is no folder {folder.parent}; create it first.")
    if folder.exists() and not folder.is_dir():
        raise UsageError(f"--out: expected a folder, but {folder} is a file.")
    try:
        main_file, files = _export(opened, form, folder)
    except OSError as error:
        raise UsageError(f"--out: {folder} cannot be written ({error.strerror}).") from error
    notes = form.notes(opened)
    if as_json:
        print_json({"scene": opened.name, "file": str(main_file), "files": list(map(str, files)), "notes": notes})
        return
    for note in notes:
        tell(f"{opened.name}: {note}.")
    opens = f"; open it with: {form.command(opened, shlex.quote(str(main_file)))}" if form.command else ""
    say(f"Wrote {main_file}{opens}")


def _export(scene: Scene, form: Format, folder: Path) -> tuple[Path, list[Path]]:
    """The main file, and all files; written beside the folder first, so that a failure leaves nothing half-written."""
    with TemporaryDirectory(prefix=".", dir=folder.parent) as unfinished:
        main_file = form.write(scene, Path(unfinished))
        folder.mkdir(exist_ok=True)
        files = [path.replace(folder / path.name) for path in sorted(Path(unfinished).iterdir())]
    return folder / main_file.name, files
