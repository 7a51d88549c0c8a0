"""A pixel's proof as plain data: its ray tree and the enclosure of its value, which anybody can verify again."""

from __future__ import annotations

import hashlib
import math
from typing import TYPE_CHECKING, Any, Literal

from raytruth.reference_tracer.certification import Certifier
from raytruth.reference_tracer.explanation import explain
from raytruth.reference_tracer.explanation_record import Explanation, Record, Vector

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


class PixelProof(Record):
    """What is claimed of a pixel."""

    proof_version: Literal[1] = 1
    scene_digest: str
    """SHA-256 of the whole scene, of its meshes too: a proof is about this scene and no other."""
    low: Vector
    """The true colour lies between `low` and `high` in each channel; float64, linear."""
    high: Vector
    undecided: str | None
    """Why the value is left open, in words: then `low` and `high` hold all outcomes. None where it is proven."""
    explanation: Explanation


def pixel_proof(scene: Scene, column: int, row: int) -> PixelProof:
    """The proof of a pixel, by ball arithmetic and by the ray tree in Python floats.

    Raises ExplanationError for a pixel outside the image, one without a value, or a tree of more rays than a person
    reads.
    """
    tree = explain(scene, column, row)
    proven = Certifier(scene).pixel(column, row)
    low, high = (_ends(proven.middle, proven.radius, sign) for sign in (-1, 1))
    undecided = None if proven.undecided is None else proven.undecided.explanation
    return PixelProof(scene_digest=scene_digest(scene), low=low, high=high, undecided=undecided, explanation=tree)


def what_is_wrong(scene: Scene, proof: PixelProof) -> list[str]:
    """What a proof claims that is not so, a sentence each, after all of it was computed again; nothing if it holds.

    Raises ExplanationError as `pixel_proof` does.
    """
    if proof.scene_digest != scene_digest(scene):
        return ["scene_digest: the proof is about another scene, or another version of this one."]
    again = pixel_proof(scene, proof.explanation.x, proof.explanation.y)
    problems = [
        f"{place}: the proof says {claimed!r}, but it is {found!r}."
        for place, claimed, found in _differences(
            proof.explanation.model_dump(), again.explanation.model_dump(), "explanation"
        )
    ]
    for channel, name in enumerate(("red", "green", "blue")):
        # A claim is verified where what is proven lies within it: the same arithmetic proves the same again.
        if not (proof.low[channel] <= again.low[channel] and again.high[channel] <= proof.high[channel]):
            problems.append(
                f"low, high: the proof says that {name} is {proof.low[channel]!r} to {proof.high[channel]!r}, but what "
                f"can be proven is {again.low[channel]!r} to {again.high[channel]!r}."
            )
    if proof.undecided is None and again.undecided is not None:
        problems.append(f"undecided: the proof says that the value is decided, but {again.undecided}")
    return problems


def scene_digest(scene: Scene) -> str:
    """SHA-256 of a scene as JSON."""
    return hashlib.sha256(scene.model_dump_json().encode()).hexdigest()


def _ends(middle: Vector, radius: Vector, sign: int) -> Vector:
    """The lower or upper ends, rounded away from the middle."""
    red, green, blue = (
        math.nextafter(m + sign * r, sign * math.inf) if r else m for m, r in zip(middle, radius, strict=True)
    )
    return red, green, blue


def _differences(claimed: Any, found: Any, place: str) -> list[tuple[str, object, object]]:
    """The places where two trees of plain data differ, with what stands there in each."""
    if isinstance(claimed, dict) and isinstance(found, dict):
        return [d for key in found for d in _differences(claimed.get(key), found[key], f"{place}.{key}")]
    if isinstance(claimed, tuple | list) and isinstance(found, tuple | list) and len(claimed) == len(found):
        pairs = enumerate(zip(claimed, found, strict=True))
        return [d for i, (one, other) in pairs for d in _differences(one, other, f"{place}.{i}")]
    same = claimed == found or (claimed != claimed and found != found)  # noqa: PLR0124 - not-a-number differs from itself
    return [] if same else [(place, claimed, found)]
