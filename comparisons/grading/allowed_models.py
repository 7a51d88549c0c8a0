"""From what an assignment allows to the error models that pixels are held to."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.renderers.program.declaration import Declaration, Rays
from raytruth.comparisons.renderers.program.declared_model import contradictions, error_model_of_declaration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from raytruth.comparisons.error_models.error_model import ErrorModel
    from raytruth.comparisons.grading.assignment import AllowedModel

RADIANCE = OutputModel("float64")
"""Alters nothing: so one feasible set serves programs that write whatever format."""


def model_problems(model: AllowedModel) -> Iterator[tuple[tuple[str, ...], str]]:
    """Place and sentence for each key of an allowed model that does not go with another."""
    found = list(contradictions(_as_declared(model)))
    yield from found
    if model.epsilon and model.rays != Rays():
        yield ("epsilon",), "expected either epsilon or rays, found both; leave one out."
    elif model.epsilon and not found:
        try:
            radiance_model(model)
        except ValueError as error:
            yield ("epsilon",), f"expected formulas that go with an epsilon: {error}."


def radiance_model(model: AllowedModel) -> ErrorModel:
    """The error model of what is computed, before anything is written.

    Raises ValueError where its parts do not go together.
    """
    computed = replace(error_model_of_declaration(_as_declared(model)), output=RADIANCE)
    if not model.epsilon:
        return computed
    return replace(computed, ray_offset=RayOffset(absolute=model.epsilon, is_bound=True))


def _as_declared(model: AllowedModel) -> Declaration:
    """The same keys as those of a program, whose name and command do not matter here."""
    return Declaration(
        name="allowed",
        command=("{scene}", "{output}"),
        arithmetic=model.arithmetic,
        rays=model.rays,
        formulas=model.formulas,
        model=model.model,
    )
