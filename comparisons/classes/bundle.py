"""What a teacher uploads so that a service grades by an assignment: scripts, a container file, a workflow."""

from __future__ import annotations

import json
import shutil
import uuid
from pathlib import Path
from typing import TYPE_CHECKING

from raytruth.reference_tracer.storage.whole_files import write_whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.grading.assignment import Assignment
    from raytruth.comparisons.records.class_results import Service

_TEMPLATES = Path(__file__).with_name("bundles")
_ASSIGNMENT_FOLDERS: dict[Service, str] = {
    "gradescope": ".",
    "prairielearn": "tests",
    "github-classroom": ".github/classroom",
}
"""Where a service's scripts look for assignment.toml."""
ARCHIVE = "autograder.zip"
"""What Gradescope takes: all of the bundle in one file."""
_MESHES = (".ply", ".obj")


class BundleError(Exception):
    """A bundle cannot be written; the message is one sentence."""


def write_bundle(service: Service, assignment: Assignment, path: Path, out: Path) -> list[Path]:
    """Write a service's files, with the assignment of this path and its own scenes, to a new folder.

    Returns what is in it, as paths from it. Raises BundleError where there is such a folder, or where a scene lies
    outside of the assignment's folder, and OSError.
    """
    own_scenes = list(_own_scenes(assignment, path.parent))
    if out.exists():
        raise BundleError(f"--out: {out} is there already; it is left as it is.")
    shutil.copytree(_TEMPLATES / service, out / ".github" if service == "github-classroom" else out)
    for file in [it for it in out.rglob("*") if it.suffix in {".json", ""} and it.is_file()]:
        _fill(file, assignment)
    target = out / _ASSIGNMENT_FOLDERS[service]
    write_whole(target / "assignment.toml", path.read_bytes())
    for scene in own_scenes:
        copy = target / scene.relative_to(path.parent)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(scene, copy)
    for script in [it for it in out.rglob("*") if it.is_file() and it.read_bytes().startswith(b"#!")]:
        script.chmod(0o755)
    written = sorted(it.relative_to(out) for it in out.rglob("*") if it.is_file())
    if service == "gradescope":
        shutil.make_archive(str(out.with_name(f".{out.name}")), "zip", out)
        out.with_name(f".{out.name}.zip").replace(out / ARCHIVE)
        written.append(Path(ARCHIVE))
    return written


def _fill(file: Path, assignment: Assignment) -> None:
    """Put the assignment's name into the few places that are for it."""
    name = assignment.name.lower()
    values = {"name": name, "title": json.dumps(assignment.title)[1:-1], "uuid": uuid.uuid5(uuid.NAMESPACE_OID, name)}
    text = file.read_text(encoding="utf-8")
    for key, value in values.items():
        text = text.replace(f"{{{key}}}", str(value))
    file.write_text(text, encoding="utf-8")


def _own_scenes(assignment: Assignment, folder: Path) -> Iterator[Path]:
    """The scene files that lie beside the assignment or below, and the meshes in their folders. Raises BundleError."""
    for source in dict.fromkeys(name for topic in assignment.topics for name in topic.scenes):
        if not source.lower().endswith(".json"):
            continue
        if not (folder / source).resolve().is_relative_to(folder.resolve()):
            raise BundleError(
                f"topics: expected scenes in the assignment's folder or below, found {source}; copy it there."
            )
        yield folder / source
        yield from (it for it in (folder / source).parent.rglob("*") if it.suffix.lower() in _MESHES and it.is_file())
