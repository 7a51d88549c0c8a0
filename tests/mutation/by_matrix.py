"""The conformance matrix as the judge of mutants: each is one more fault, planted as those of the catalogue are."""

from __future__ import annotations

import importlib.util
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.faults.fault import Subject
from raytruth.comparisons.kills.kill_matrix import kills_on
from raytruth.comparisons.matrix.quick_suite import quick_scenes
from raytruth.scenes.library import library_names, open_scene

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path
    from types import ModuleType

    from tests.mutation.mutants import Mutant


def all_scenes() -> tuple[str, ...]:
    """The whole library, those of the quick suite first: they find most."""
    return (*quick_scenes(), *(name for name in library_names() if name not in quick_scenes()))


def judge_all(mutants: Sequence[Mutant], folder: Path, scenes: Sequence[str]) -> list[str]:
    """The scene that kills each mutant, the first in the order tried; `survived`, or `not planted`.

    A constant of a file is no function that a fault could replace. The mutants' files are written to the folder.
    """
    folder.mkdir(exist_ok=True)
    subjects = [_subject(str(place), mutant, folder) for place, mutant in enumerate(mutants)]
    killed: dict[str, str] = {}
    for name in scenes:
        waiting = [subject for subject in subjects if subject is not None and subject.name not in killed]
        for cell in kills_on(open_scene(name), waiting).cells:
            if cell.fails:
                killed[cell.subject] = name
    return ["not planted" if subject is None else killed.get(subject.name, "survived") for subject in subjects]


def _subject(name: str, mutant: Mutant, folder: Path) -> Subject | None:
    if not mutant.function:
        return None
    path = folder / f"mutant_{name}_{mutant.file}.py"
    path.write_text(mutant.source(), encoding="utf-8")
    function: Any = getattr(_loaded(path), mutant.function)
    return Subject(name, f"{mutant.before} → {mutant.after}", {mutant.function: function})


def _loaded(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
