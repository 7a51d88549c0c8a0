"""Waivers: failures that are known, each with its reason, and with the most that it excuses.

A waived failure stays a failure: it only does not make the run fail. A waiver that matches nothing does.
"""

from __future__ import annotations

import fnmatch
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, TypeAdapter, ValidationError, model_validator

from raytruth.comparisons.matrix.scene_properties import PROPERTIES, Property
from raytruth.comparisons.records.results import Cell, Link, Record, Verdict, Waived
from raytruth.comparisons.renderers.catalogue import all_renderers
from raytruth.scenes.wording import described, place, quoted, suggestion

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from raytruth.comparisons.renderers.protocol import Renderer
    from raytruth.scenes.scene import Scene

PACKAGED = Path(__file__).with_name("waivers.json")
"""The failures that are known of the renderers of the catalogue."""

Text = Annotated[str, Field(min_length=1)]


class WaiverError(Exception):
    """A file of waivers cannot be used; the message is one sentence."""


class Waiver(Record):
    """A known failure of a renderer, which does not make a run fail; see docs/how-verdicts-work.md.

    It is of one scene, or of all scenes that have a property in which the renderer is wrong.
    """

    renderer: Text
    version: Text
    """Pattern of the renderer's version, in which `*` stands for anything."""
    scene: Text | None = None
    most_failing_pixels: Annotated[int, Field(ge=0)] | None = None
    """So many pixels or first hits of the scene may fail; if more do, something else is wrong, too."""
    scenes_with: Property | None = None
    integrator: Text
    reason: Text
    link: Link

    @property
    def place(self) -> str:
        """The cell that it is about, in words."""
        return f"{self.renderer}/{self.integrator} on {self.scene}"

    @model_validator(mode="after")
    def _of_a_scene_or_of_a_property(self) -> Waiver:
        if (self.scene is None) == (self.scenes_with is None):
            raise ValueError("expected either scene or scenes_with")
        if (self.scene is None) != (self.most_failing_pixels is None):
            raise ValueError("expected most_failing_pixels with scene, and not with scenes_with")
        return self


_WAIVERS = TypeAdapter(tuple[Waiver, ...])


def load_waivers(path: Path = PACKAGED, programs: Iterable[Renderer] = ()) -> tuple[Waiver, ...]:
    """The waivers in a JSON file, a list of objects with the keys of Waiver. Raises WaiverError.

    They may be about renderers that raytruth knows, and about these programs of its user.
    """
    try:
        waivers = _WAIVERS.validate_json(path.read_bytes())
    except OSError as error:
        raise WaiverError(f"{path}: expected a readable file of waivers: {error.strerror}.") from error
    except ValidationError as error:
        raise WaiverError(f"{path}: {_first_problem(error)}") from error
    for number, waiver in enumerate(waivers):
        for key, name, known in _names(waiver, programs):
            if name not in known:
                problem = f"there is none called {quoted(name)}: {suggestion(name, known)}"
                raise WaiverError(f"{path}: [{number}].{key}: {problem}")
    return waivers


def apply_waivers(
    waivers: Iterable[Waiver],
    cells: Sequence[Cell],
    versions: Mapping[str, str | None],
    scenes: Iterable[Scene],
) -> tuple[list[Cell], list[str]]:
    """The cells, waived where they fail as a waiver says; a sentence for each of a scene that matches nothing.

    `versions` has each renderer that was run, and `scenes` are those of the cells. Waivers of other renderers, versions
    and scenes are left alone, as are those of cells that ended in an error, which fail the run by themselves.
    """
    after, by_name = list(cells), {scene.name: scene for scene in scenes}
    unmatched = []
    for waiver in waivers:
        if not fnmatch.fnmatchcase(versions.get(waiver.renderer) or "", waiver.version):
            continue
        for index, cell in enumerate(after):
            if not _is_about(waiver, cell, by_name):
                continue
            if cell.verdict == Verdict.FAIL and _excuses(waiver, cell):
                after[index] = cell.model_copy(update={"waived": Waived(reason=waiver.reason, link=waiver.link)})
            elif cell.verdict != Verdict.ERROR and waiver.scene is not None:
                unmatched.append(f"The waiver of {waiver.place} matches nothing, since {_found(cell, waiver)}.")
    return after, unmatched


def _is_about(waiver: Waiver, cell: Cell, scenes: Mapping[str, Scene]) -> bool:
    """Whether the cell is the waiver's: of its scene, or of one that has its property and no waiver of its own."""
    if (cell.renderer, cell.integrator) != (waiver.renderer, waiver.integrator):
        return False
    if waiver.scenes_with is None:
        return waiver.scene == cell.scene
    scene = scenes.get(cell.scene)
    return cell.waived is None and scene is not None and PROPERTIES[waiver.scenes_with](scene)


def _excuses(waiver: Waiver, cell: Cell) -> bool:
    return waiver.most_failing_pixels is None or _failing(cell) <= waiver.most_failing_pixels


def _failing(cell: Cell) -> int:
    """How many pixels or first hits fail."""
    return sum(part.failing for part in (cell.judgement, cell.first_hits) if part is not None)


def _found(cell: Cell, waiver: Waiver) -> str:
    if cell.verdict == Verdict.FAIL:
        return f"{_failing(cell)} pixels fail, more than the {waiver.most_failing_pixels} that it excuses"
    return f"the verdict is {cell.verdict}: remove it"


def _names(waiver: Waiver, programs: Iterable[Renderer]) -> Iterator[tuple[str, str, list[str]]]:
    """Key, name, and which names there are."""
    renderers = all_renderers() | {program.name: program for program in programs}
    yield "renderer", waiver.renderer, list(renderers)
    if waiver.renderer in renderers:
        yield "integrator", waiver.integrator, [known.name for known in renderers[waiver.renderer].integrators]


def _first_problem(error: ValidationError) -> str:
    first, *others = error.errors(include_url=False)
    more = f" (and {len(others)} more)" if others else ""
    found = "" if first["type"] in {"missing", "json_invalid"} else f", found {described(first['input'])}"
    return f"{place(first['loc'])}: {first['msg']}{found}{more}."
