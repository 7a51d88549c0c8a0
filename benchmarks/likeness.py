"""How often `raytruth grade-all` calls independent programs alike: the example tracers, right and with equal mistakes.

They were written apart from one another, each to the specification. What the mistakes are called in the catalogue is
taken as told, as a diagnosis tells it; and once it is not, as if the catalogue lacked them. Each pair is compared as if
the two were alone, so that nothing that they have in common counts as common: a class makes fewer false matches. Needs
the languages' compilers; takes some minutes.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from raytruth.comparisons.classes.likeness import Explained, likenesses, telling_pixels
from raytruth.comparisons.grading.assignment_file import assignment_path, load_assignment
from raytruth.comparisons.grading.assignment_scenes import scenes_of
from raytruth.comparisons.grading.submission import as_graded, submitted
from raytruth.comparisons.renderers.program.declared_model import output_model_of
from raytruth.programs import program_of_file

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

EXAMPLES = Path(__file__).parents[1] / "examples" / "tracers"
ASSIGNMENT = "whitted"
SOURCES = {
    "python": ("tracer.py", ["true"]),
    "javascript": ("tracer.mjs", ["true"]),
    "cpp": ("tracer.cpp", ["g++", "-std=c++17", "-O2", "tracer.cpp", "-o", "tracer"]),
    "java": ("Tracer.java", ["javac", "-d", "build", "Json.java", "Scene.java", "Tracer.java"]),
    "go": ("tracer.go", ["go", "build", "-o", "tracer", "."]),
    "rust": ("tracer.rs", ["rustc", "--edition", "2021", "-O", "tracer.rs", "-o", "tracer"]),
}
"""The file of each language that holds the physics, and what builds it."""
QUADRATIC = ("uadratic * distance * distance", "uadratic*distance*distance", "uadratic() * distance * distance")
MISTAKES: dict[str, dict[str, str]] = {
    "no mistake": {},
    "one over the distance": {old: old.removesuffix(" * distance").removesuffix("*distance") for old in QUADRATIC},
    "no falloff": {"1 / divisor": "1", "1.0 / divisor": "1.0"},
}
"""What is written otherwise wherever it stands."""
KNOWN_AS = {"one over the distance": ("one_over_distance",), "no falloff": ("no_falloff",)}
"""The faults of the catalogue that these are."""
FLOAT32 = {
    "float32": [],
    "float32 with fast maths": ["-ffast-math", "-mfma"],
    "float32 with an epsilon": ["-DEPSILON=1e-3"],
}


@dataclass(frozen=True)
class Variant:
    """An example tracer with a mistake, or in another arithmetic."""

    language: str
    mistake: str
    arithmetic: str = "float64"

    def made(self, folder: Path) -> Path:
        """Its source, altered and built in a folder of its own; the file that declares it."""
        work = folder / self.name
        shutil.copytree(EXAMPLES / self.language, work)
        file, build = SOURCES[self.language]
        text = (work / file).read_text(encoding="utf-8")
        for old, new in MISTAKES[self.mistake].items():
            text = text.replace(old, new)
        (work / file).write_text(text, encoding="utf-8")
        own = ["-DREAL=float", *FLOAT32[self.arithmetic]] if self.arithmetic in FLOAT32 else []
        subprocess.run([*build, *own], cwd=work, check=True, capture_output=True)
        return work / "tracer.toml"

    @property
    def name(self) -> str:
        """What tells it from the others."""
        return f"{self.language}, {self.mistake}, {self.arithmetic}".replace(" ", "-")


def variants() -> list[Variant]:
    """All languages with each mistake, and C++ in float32."""
    found = [Variant(language, mistake) for mistake in MISTAKES for language in SOURCES]
    return found + [Variant("cpp", mistake, arithmetic) for mistake in MISTAKES for arithmetic in FLOAT32]


Pictures = dict[str, "NDArray[np.float32]"]


def pictures_of(variant: Variant, folder: Path) -> dict[str, Pictures]:
    """The telling pixels of each scene of the assignment, where its mistake is known, and where it is not."""
    path = assignment_path(ASSIGNMENT)
    assignment = load_assignment(path)
    program = as_graded(program_of_file(variant.made(folder)), assignment)
    declared = output_model_of(program.declaration)
    scenes = {scene.name: scene for of_topic in scenes_of(assignment, path.parent).values() for scene in of_topic}
    given = {name: submitted(program, scene).image for name, scene in scenes.items()}
    told = {"known": Explained(faults=KNOWN_AS.get(variant.mistake, ())), "unknown": Explained()}
    return {
        kind: {
            name: telling_pixels(scenes[name], image, declared, it)
            for name, image in given.items()
            if image is not None
        }
        for kind, it in told.items()
    }


def kind_of(first: Variant, second: Variant) -> str:
    """What two variants of independent programs have in common."""
    mistake = first.mistake if first.mistake == second.mistake else "other mistakes"
    precision = sorted({"float64" if it.arithmetic == "float64" else "float32" for it in (first, second)})
    return f"{mistake}, {' and '.join(precision)}"


def main() -> None:
    """Print, for each kind of pair, how many there are, how many are called alike, and how alike they are at most."""
    with TemporaryDirectory(prefix="raytruth-") as name:
        pictures = {variant: pictures_of(variant, Path(name)) for variant in variants()}
    rows: dict[str, list[float]] = {}
    for first, second in combinations(pictures, 2):
        if first.language == second.language:  # one program with one line otherwise is no independent one
            continue
        for known in ("known", "unknown"):
            found = likenesses({first.name: pictures[first][known], second.name: pictures[second][known]})
            share = max((it.alike / it.looked_at for it in found), default=0.0)
            rows.setdefault(f"{kind_of(first, second)}, {known}", []).append(share)
    if "--json" in sys.argv:
        print(json.dumps(rows, indent=1))
        return
    for kind, shares in sorted(rows.items()):
        print(f"| {kind} | {len(shares)} | {sum(share > 0 for share in shares)} |")


if __name__ == "__main__":
    main()
