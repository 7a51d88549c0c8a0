"""By which mistake a submission is told together with others, and why its grade moved."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.records.grade_results import Grade

ALL_RIGHT = "all right"
UNKNOWN = "no known mistake"
NOTHING_RENDERED = "no picture of any scene"


def group_of(grade: Grade) -> str:
    """What explains what is wrong: global mistakes and the fault of the diagnosis, not the scenes in which it shows."""
    if grade.scenes and all(it.verdict == "error" for it in grade.scenes):
        return NOTHING_RENDERED
    parts = [it.name for it in grade.mistakes]
    if grade.diagnosis:
        first = grade.diagnosis[0]
        parts.append(first.fault if first.is_whole else f"{first.fault}, in part")
    elif grade.unexplained:
        parts.append(UNKNOWN)
    if not parts and any(it.verdict == "error" for it in grade.scenes):
        parts.append("no picture of some scenes")
    return " and ".join(parts) or (ALL_RIGHT if grade.score == grade.maximum else UNKNOWN)


def why_moved(before: Grade | None, after: Grade | None) -> tuple[str, ...]:
    """A sentence for each thing that is otherwise in a grade than it was before."""
    if before is None or after is None:
        return ("There was no grade before.",) if before is None else ("There is no grade now.",)
    return tuple(_differences(before, after))


def _differences(before: Grade, after: Grade) -> Iterator[str]:
    if before.raytruth_version != after.raytruth_version:
        yield f"raytruth {before.raytruth_version} is {after.raytruth_version} now."
    if before.maximum != after.maximum:
        yield f"The maximum was {before.maximum:g} points and is {after.maximum:g}."
    was, is_now = ({it.name: it for it in grade.scenes} for grade in (before, after))
    for name in sorted(was.keys() | is_now.keys()):
        if name not in was or name not in is_now:
            yield f"{name} {'is new' if name in is_now else 'is not asked for any more'}."
        elif (was[name].verdict, was[name].credit) != (is_now[name].verdict, is_now[name].credit):
            old, new = (f"{it.verdict} ({it.reason.rstrip('.')})" for it in (was[name], is_now[name]))
            yield f"{name} was {old} and is {new}."
    mistakes = [", ".join(it.name for it in grade.mistakes) or "none" for grade in (before, after)]
    if mistakes[0] != mistakes[1]:
        yield f"Global mistakes: {mistakes[0]}, now {mistakes[1]}."
