"""The values scenes are made of: finite numbers, vectors, colours, each checked where it is read."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

# Coordinates beyond this leave no room for a product of three of them in float32 (its largest finite number is 3.4e38).
LARGEST_COORDINATE = 1e12
# An index of refraction under this makes every ray that leaves the medium totally reflected for any float32 angle.
SMALLEST_INDEX = 1e-6

Number = Annotated[float, Field(allow_inf_nan=False, strict=True)]
Coordinate = Annotated[float, Field(allow_inf_nan=False, strict=True, ge=-LARGEST_COORDINATE, le=LARGEST_COORDINATE)]
Positive = Annotated[float, Field(allow_inf_nan=False, strict=True, gt=0, le=LARGEST_COORDINATE)]
NonNegative = Annotated[float, Field(allow_inf_nan=False, strict=True, ge=0, le=LARGEST_COORDINATE)]

Vector = tuple[Coordinate, Coordinate, Coordinate]
Color = tuple[NonNegative, NonNegative, NonNegative]
"""Linear RGB, each component 0 or more; reflectances may exceed 1, so that a test can break energy conservation."""


# The square of a shorter vector leaves the normal float32 numbers, whose smallest is 1.2e-38.
SHORTEST_DIRECTION = 1e-18


def _not_zero(vector: Vector) -> Vector:
    if vector == (0.0, 0.0, 0.0):
        raise ValueError("expected a vector that is not zero, since it gives a direction")
    if max(map(abs, vector)) < SHORTEST_DIRECTION:
        raise ValueError(f"expected a vector longer than {SHORTEST_DIRECTION:g}, since it gives a direction")
    return vector


_LONG_ENOUGH = {"contains": {"anyOf": [{"minimum": SHORTEST_DIRECTION}, {"maximum": -SHORTEST_DIRECTION}]}}

Direction = Annotated[Vector, AfterValidator(_not_zero), Field(json_schema_extra=_LONG_ENOUGH)]


class Part(BaseModel):
    """A part of a scene: immutable, and without keys that it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True)
