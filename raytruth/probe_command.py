"""`raytruth renderers --probe`: which declaration fits a program."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from raytruth.comparisons.matrix.probe import most_bits, pictures_of, tightest_declaration, verdicts
from raytruth.comparisons.matrix.quick_suite import quick_scenes, small
from raytruth.comparisons.records.renderings import RendererError
from raytruth.errors import UsageError
from raytruth.output import print_json, progress, say
from raytruth.programs import programs_of
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from raytruth.comparisons.matrix.probe import Found, Picture
    from raytruth.comparisons.renderers.program.declaration import Declaration

FAILED = 1


def tell_tightest_declaration(file: Path, *, as_json: bool) -> int:
    """Tell the tightest declaration under which the program passes the quick suite; exit status 1 if there is none.

    Raises UsageError for a file that declares no program, and for a program that draws random numbers, or fails to
    render.
    """
    (program,) = programs_of((), (file,)).values()
    declaration = program.declaration
    if declaration.sampling.samples:
        raise UsageError(f"--probe: {file}: expected no samples under [sampling]: only what is exact can be probed.")
    try:
        with progress("Rendering the quick suite"):
            pictures = pictures_of(program, [small(open_scene(name)) for name in quick_scenes()])
    except RendererError as error:
        raise UsageError(f"--probe: {file}: {error}.") from error
    if not pictures:
        raise UsageError(
            f"--probe: {file}: expected a scene that it does not refuse; it refuses the whole quick suite."
        )
    with progress("Trying declarations"):
        found = tightest_declaration(declaration, pictures)
        counts = _counts(declaration, found, pictures)
    if as_json:
        print_json({"lines": _lines(declaration, found), "verdicts": counts, "decided_by": _obstacle(found)})
    else:
        _show(declaration, found, counts, str(file))
    return 0 if counts else FAILED


def _counts(declaration: Declaration, found: Found, pictures: Sequence[Picture]) -> dict[str, int]:
    """How many pictures get which verdict; empty where no declaration was found."""
    if found.bits is None:
        return {}
    given = list(verdicts(declaration, found, pictures).values())
    return {verdict: given.count(verdict) for verdict in dict.fromkeys(given)}


def _lines(declaration: Declaration, found: Found) -> list[str]:
    """What to write into the file, line by line."""
    if found.bits is None:
        return []
    precision = declaration.arithmetic.precision
    slack = most_bits(declaration) - found.bits
    bits = [f"bits = {found.bits}"] if precision is None else [f'precision = "{precision}"', f"slack_bits = {slack}"]
    stated = found.rays.model_dump(exclude_defaults=True, exclude_none=True)
    simple = {key: value for key, value in stated.items() if not isinstance(value, dict)}
    parts = {key: value for key, value in stated.items() if isinstance(value, dict)}
    rays = ["[rays]", *_keys(simple)] if simple else []
    for key, part in parts.items():
        rays += [f"[rays.{key}]", *_keys(part)]
    return ["[arithmetic]", *bits, *rays]


def _keys(table: dict[str, Any]) -> list[str]:
    """A number has all its digits, as it is the declared one."""
    return [f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value!r}" for key, value in table.items()]


def _obstacle(found: Found) -> dict[str, Any] | None:
    if found.obstacle is None:
        return None
    return {"scene": found.obstacle.scene, "pixel": found.obstacle.pixel.model_dump(mode="json")}


def _show(declaration: Declaration, found: Found, counts: dict[str, int], file: str) -> None:
    if found.bits is None:
        say("No number of bits and none of the usual ray offsets explains what this program gives.")
        say(f"{_place(found)}, with half the bits of its numbers as well.")
        say(
            "What it does otherwise may be a convention or a formula that can be declared (docs/your-renderer.md), else"
        )
        say(f"it is a mistake: raytruth run --quick --renderer-file {file}")
        return
    told = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
    say(f"The tightest declaration that was found; of the quick suite's pictures {told}:")
    say("")
    for line in _lines(declaration, found):
        say(line)
    say("")
    if found.obstacle is None:
        say("These are all bits of its numbers.")
    else:
        say(f"What decides: with one bit more, {_place(found)}.")
    if not found.rays.model_dump(exclude_defaults=True):
        say("Its rays need no offset and no least distance.")


def _place(found: Found) -> str:
    """The pixel in the way, in words."""
    assert found.obstacle is not None, "there is one where bits are missing"
    pixel = found.obstacle.pixel
    value, truth = (", ".join(f"{number:.9g}" for number in color) for color in (pixel.value, pixel.truth))
    return f"{found.obstacle.scene} fails at column {pixel.x}, row {pixel.y}: ({value}) where ({truth}) is due"
