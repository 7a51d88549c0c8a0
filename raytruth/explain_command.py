"""`raytruth explain`."""

from __future__ import annotations

import json
from pathlib import Path  # noqa: TC003 - cyclopts reads annotations at run time
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter
from pydantic import ValidationError

from raytruth.api import images
from raytruth.errors import UsageError
from raytruth.options import AsJson, open_scene, parse_pixel
from raytruth.output import print_json, say
from raytruth.reference_tracer.explanation import ExplanationError
from raytruth.reference_tracer.pixel_proof import PixelProof, pixel_proof, what_is_wrong
from raytruth.reference_tracer.storage.whole_files import write_whole
from raytruth.reports.explanation_text import explanation_text

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

LARGEST_PROOF = 64 * 2**20
"""Bytes: the ray tree of a pixel has at most some thousand rays of some kilobytes each."""
MOST_PROBLEMS = 10
"""What is told of a proof that does not hold: one wrong number spoils many others."""
REFUTED = 1


def explain(
    scene: str,
    /,
    *,
    pixel: Annotated[str | None, Parameter(allow_leading_hyphen=True)] = None,
    hexadecimal: Annotated[bool, Parameter(name="--hex", negative="")] = False,
    proof: Path | None = None,
    check: Path | None = None,
    as_json: AsJson = False,
) -> int:
    """Explain one pixel: every ray of its tree, every hit, normal, term and weight, and the sum.

    Parameters
    ----------
    scene
        A scene of the library, or the path of a .json file.
    pixel
        X,Y: column from the left, row from the top, both from 0.
    hexadecimal
        Print numbers as hexadecimal floats, which are exact; those of --json always are.
    proof
        Also write the ray tree and the proven enclosure of the value to this JSON file.
    check
        Instead of explaining, compute all again that such a file claims, and tell what does not hold.
    as_json
        Print one JSON document instead of text.
    """
    if (pixel is None) == (check is None) or (check is not None and proof is not None):
        raise UsageError("explain: expected either --pixel X,Y, or --check FILE alone.")
    opened = open_scene(scene)
    try:
        if check is not None:
            return _check(opened, check, as_json=as_json)
        _explain(opened, parse_pixel(pixel or ""), proof, hexadecimal=hexadecimal, as_json=as_json)
    except ExplanationError as error:
        raise UsageError(str(error)) from error
    return 0


def _explain(scene: Scene, pixel: tuple[int, int], proof: Path | None, *, hexadecimal: bool, as_json: bool) -> None:
    tree = images.explain(scene, *pixel)
    if proof is not None:
        write_whole(proof, f"{pixel_proof(scene, *pixel).model_dump_json(indent=1)}\n")
    if as_json:
        print_json(json.loads(tree.model_dump_json()))
    else:
        print(explanation_text(tree, hexadecimal), end="")


def _check(scene: Scene, file: Path, *, as_json: bool) -> int:
    proof = _read(file)
    problems = what_is_wrong(scene, proof)
    place = f"pixel ({proof.explanation.x}, {proof.explanation.y}) of {scene.name}"
    if as_json:
        print_json({"holds": not problems, "problems": problems})
    elif not problems:
        say(f"The proof of {place} holds.")
    else:
        say(f"The proof of {place} does not hold:")
        for problem in problems[:MOST_PROBLEMS]:
            say(f"  {problem}")
        if len(problems) > MOST_PROBLEMS:
            say(f"  and {len(problems) - MOST_PROBLEMS} more.")
    return REFUTED if problems else 0


def _read(file: Path) -> PixelProof:
    """Raises UsageError for a file that is no proof, with every mistake of it."""
    with file.open("rb") as opened:
        content = opened.read(LARGEST_PROOF + 1)
    if len(content) > LARGEST_PROOF:
        raise UsageError(f"{file}: expected a proof of at most {LARGEST_PROOF // 2**20} MiB, found more.")
    try:
        return PixelProof.model_validate_json(content)
    except ValidationError as error:
        places = [(".".join(map(str, problem["loc"])) or "the file", problem["msg"]) for problem in error.errors()]
        sentences = [
            f"{file}: {place}: {message}; write it anew by raytruth explain --proof." for place, message in places
        ]
        raise UsageError("\n".join(sentences)) from error
