"""Which pairs of sayings (coverage.py) no scene says together, and why some pairs never can be."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from raytruth.scenes.coverage import said_by, sayings
from raytruth.scenes.families.language import language, rows
from raytruth.scenes.library import library_names, open_scene
from raytruth.scenes.materials import Material

if TYPE_CHECKING:
    from collections.abc import Iterable


Pair = tuple[str, str]

RADIOMETRIC = "convention is radiometric"
CLASSICAL = (
    "ambient_light",
    "lights[].falloff is none",
    "lights[].falloff is PolynomialFalloff",
    "materials.*.dielectric.reflectance",
    "materials.*.dielectric.transmittance",
)
"""What only the classical equation has, beside whole terms, which say so themselves (consistency.py)."""
FROM_A_FILE = "objects[].file"


@dataclass(frozen=True)
class Coverage:
    """What the library and the family `language` say."""

    by_library: Counter[str]
    """How many scenes of the library say each thing."""
    by_family: Counter[str]
    pairs: int
    """How many pairs a scene may say together."""
    impossible: Counter[str]
    """How many pairs cannot be said together or need not be, by the reason."""
    only_in_family: int
    """How many pairs the family alone says."""
    holes: tuple[str, ...]
    """What no scene of the library says."""
    pair_holes: tuple[Pair, ...]
    """Pairs that neither the library nor the family says, though a scene may."""


def coverage() -> Coverage:
    """Measured on all scenes of the library and one scene for each row of the family `language`."""
    library = [said_by(open_scene(name)) for name in library_names()]
    family = [said_by(language(float(row), 0)) for row in range(len(rows()))]
    return measured(library, family)


def measured(library: Iterable[frozenset[str]], family: Iterable[frozenset[str]]) -> Coverage:
    """The same for what scenes of the library and of the family say."""
    said, drawn = list(library), list(family)
    reasons = {pair: why_not_together(*pair) for pair in combinations(sayings(), 2)}
    possible = [pair for pair, reason in reasons.items() if reason is None]
    open_in_library = [pair for pair in possible if not any(says.issuperset(pair) for says in said)]
    open_in_both = tuple(pair for pair in open_in_library if not any(says.issuperset(pair) for says in drawn))
    by_library = Counter(saying for says in said for saying in says)
    return Coverage(
        by_library=by_library,
        by_family=Counter(saying for says in drawn for saying in says),
        pairs=len(possible),
        impossible=Counter(reason for reason in reasons.values() if reason is not None),
        only_in_family=len(open_in_library) - len(open_in_both),
        holes=tuple(saying for saying in sayings() if not by_library[saying]),
        pair_holes=open_in_both,
    )


def why_not_together(one: str, other: str) -> str | None:
    """Why no scene says both, or none need do so; None if one should."""
    places = [saying.partition(" is ")[0] for saying in (one, other)]
    if places[0] == places[1] and " is " in one and " is " in other and not any(sign in one for sign in "[*"):
        return "a scene has one of them only"
    if RADIOMETRIC in (one, other):
        rest = other if one == RADIOMETRIC else one
        if rest in CLASSICAL or rest.startswith(_classical_terms()):
            return "the radiometric convention does not have it"
    if FROM_A_FILE in (one, other):
        return "the triangles of a file are the same as those stated in the scene (tests/scenes/test_mesh_spellings.py)"
    return None


def _classical_terms() -> tuple[str, ...]:
    """The keys of terms that only the classical equation has, as they are said."""
    keys = []
    for key, field in Material.model_fields.items():
        term = next(part for part in field.annotation.__args__ if part is not type(None))  # type: ignore[union-attr]
        if term.is_classical:
            keys.append(f"materials.*.{key}")
    return tuple(keys)
