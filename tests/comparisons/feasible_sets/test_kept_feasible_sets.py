from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.feasible_sets import kept_feasible_sets
from raytruth.comparisons.feasible_sets.feasible_set import FeasibleSet, feasible_set
from raytruth.comparisons.feasible_sets.kept_feasible_sets import kept_feasible_set
from tests.reference_tracer.small_scenes import library_scene, small_scene

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("RES-3")

MODEL = ErrorModel("float32", precision_bits=24)


@pytest.fixture(autouse=True)
def cache(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    monkeypatch.setattr(kept_feasible_sets, "cache_folder", lambda: tmp_path)
    return tmp_path / "feasible"


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Scene, ErrorModel]]:
    """All that were made and not taken from the cache."""
    found = []

    def recorded(scene: Scene, error_model: ErrorModel, **options: Any) -> FeasibleSet:
        found.append((scene, error_model))
        return feasible_set(scene, error_model, **options)

    monkeypatch.setattr(kept_feasible_sets, "feasible_set", recorded)
    return found


def assert_same(a: FeasibleSet, b: FeasibleSet) -> None:
    for field in fields(FeasibleSet):
        one, other = getattr(a, field.name), getattr(b, field.name)
        assert one.dtype == other.dtype
        np.testing.assert_array_equal(one, other, field.name)


def test_it_is_made_once_and_comes_back_as_it_was(made: list[Any]) -> None:
    scene, coarse = library_scene("glass-and-mirror", 8, 6), replace(MODEL, precision_bits=10)
    first = kept_feasible_set(scene, coarse)
    assert first.outcomes.max() > first.outcomes.min()  # so that there are unused places, too
    assert_same(kept_feasible_set(scene, coarse), first)
    assert len(made) == 1
    assert_same(first, feasible_set(scene, coarse))


def test_scenes_error_models_and_first_hits_alone_have_places_of_their_own(made: list[Any]) -> None:
    scene = small_scene(name="one")
    others: list[tuple[Scene, ErrorModel, bool]] = [
        (scene, MODEL, True),
        (scene, MODEL, False),
        (scene.model_copy(update={"name": "two"}), MODEL, True),
        (scene, replace(MODEL, precision_bits=23), True),
        (scene, replace(MODEL, ray_offset=RayOffset(absolute=1e-3)), True),
    ]
    for _ in range(2):
        for one, model, with_colors in others:
            kept = kept_feasible_set(one, model, with_colors=with_colors)
            assert_same(kept, feasible_set(one, model, with_colors=with_colors))
    assert len(made) == len(others)


def test_a_changed_scene_or_code_is_made_anew_and_takes_the_place(
    made: list[Any], monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    kept_feasible_set(small_scene(name="one"), MODEL)
    kept_feasible_set(small_scene(name="one", background={"color": (0.5, 0.5, 0.5)}), MODEL)
    assert len(made) == 2
    monkeypatch.setattr(kept_feasible_sets, "source_digest", lambda *_, **__: "other code")
    kept_feasible_set(small_scene(name="one", background={"color": (0.5, 0.5, 0.5)}), MODEL)
    assert len(made) == 3
    assert len(list(cache.iterdir())) == 1


@pytest.mark.parametrize("damage", ["truncated", "empty", "garbage", "flipped"])
def test_a_damaged_file_is_made_anew(made: list[Any], cache: Path, damage: str) -> None:
    scene = small_scene()
    first = kept_feasible_set(scene, MODEL)
    (file,) = cache.iterdir()
    whole = file.read_bytes()
    middle = len(whole) // 2
    flipped = bytes(byte ^ 0xFF for byte in whole[middle - 64 : middle + 64])
    file.write_bytes(
        {
            "truncated": whole[:-40],
            "empty": b"",
            "garbage": b"\x00" * len(whole),
            "flipped": whole[: middle - 64] + flipped + whole[middle + 64 :],
        }[damage]
    )
    assert_same(kept_feasible_set(scene, MODEL), first)
    assert len(made) == 2
