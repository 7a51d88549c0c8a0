"""Which line of a declaration costs the power of a test: without which one could more pixels be judged?"""

from __future__ import annotations

from dataclasses import MISSING, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.error_models.shortcuts import has_shortcuts, without_shortcuts
from raytruth.comparisons.feasible_sets.pixel_outcomes import PixelOutcomes
from raytruth.comparisons.feasible_sets.radiance_bound import radiance_bound
from raytruth.reference_tracer.arithmetics.behaviour import IDEAL

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from dataclasses import Field

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.feasible_sets.rounded_rays import Pixel
    from raytruth.scenes.scene import Scene

# Enough to tell half of the pixels from a tenth of them, and a few seconds for each line.
SAMPLE = 16
# In pixels of the sample: what a pixel takes that has a whole image's work to share with few others.
MOST_SHARES = 4
MOST_BITS = 53
"""Of float64: with these the arithmetic is left out."""
ALL_RAYS = "all of [rays]"

LINES = {
    "precision_bits": "[arithmetic]",
    "smallest": "smallest",
    "ray_offset.absolute": "offset",
    "ray_offset.relative": "relative_offset",
    "ray_offset.along": "along",
    "ray_offset.minimum_distance": "least_distance",
    "ray_offset.relative_minimum_distance": "relative_least_distance",
    "ray_offset.excludes_surface": "own_surface",
    "shadow_shortening": "shadow_shortening",
    "sphere_test": "sphere",
    "sphere_points": "sphere_normals",
    "triangle_test": "triangle",
}
"""What the fields of an error model are called in a declaration; others have the names of its keys, or none there."""

NO_LINES = {"description", "output", "camera_rays", "field_of_view", "random_choices", "largest_extent"}
"""Fields that leave no more open than the picture's numbers do, or that nothing follows from."""


def costliest_line(scene: Scene, error_model: ErrorModel, unjudged: Sequence[Pixel]) -> str:
    """The line without which most of these pixels could be judged, as a clause; empty where no single one helps.

    Each line is left out by itself, on a sample of the pixels, which are all that the error model leaves unjudged.
    """
    step = -(-len(unjudged) // SAMPLE)
    sample = unjudged[::step]
    pixels = scene.camera.width * scene.camera.height
    share = min(len(sample) / len(unjudged), MOST_SHARES * len(sample) / pixels)
    counts = {line: _judged(scene, model, sample, share) for line, model in without_each_line(error_model)}
    counts = {line: count for line, count in counts.items() if count > 0}
    if not counts:
        return ""
    line = max(counts, key=lambda line: counts[line])
    return f"what costs most is {line}: without it {counts[line]} of {len(sample)} of these could be judged"


def without_each_line(error_model: ErrorModel) -> Iterator[tuple[str, ErrorModel]]:
    """The error model without each of its lines, after the line's name. All on rays together come next to last.

    The arithmetic comes last: what it costs, too, is told only where no policy costs as much.
    """
    for field in fields(error_model):
        if field.name in NO_LINES or field.name == "precision_bits":
            continue
        value, default = getattr(error_model, field.name), _default(field)
        if value == default or default is MISSING:
            continue
        for name, left_out in _without_parts(field.name, value, default):
            try:
                yield LINES.get(name, name.rpartition(".")[2]), replace(error_model, **{field.name: left_out})
            except ValueError:  # the others do not go without it
                continue
    if has_shortcuts(error_model):
        yield ALL_RAYS, without_shortcuts(error_model)
    if error_model.precision_bits < MOST_BITS:
        yield LINES["precision_bits"], replace(error_model, precision_bits=MOST_BITS)


def _without_parts(name: str, value: Any, default: Any) -> Iterator[tuple[str, Any]]:
    """A field's default; of a bundle of fields, the bundle without each of them."""
    if not is_dataclass(value) or not isinstance(default, type(value)):
        yield name, default
        return
    bundle: Any = value  # of a class that only its fields are known of here
    for part in fields(value):
        if getattr(value, part.name) != getattr(default, part.name):
            try:
                yield f"{name}.{part.name}", replace(bundle, **{part.name: getattr(default, part.name)})
            except ValueError:  # as above
                continue


def _default(field: Field[Any]) -> Any:
    return field.default_factory() if field.default_factory is not MISSING else field.default


def _judged(scene: Scene, error_model: ErrorModel, pixels: Sequence[Pixel], share: float) -> int:
    """How many of these pixels can be judged under an error model."""
    outcomes = PixelOutcomes(scene, error_model, IDEAL, radiance_bound(scene), share)
    colors, _ = outcomes.colors_and_hits(pixels, with_hits=False)
    return sum(color is not None for color in colors)
