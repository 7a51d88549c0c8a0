"""What a teacher asks for and what it is worth: the keys of an assignment's file, each told in a sentence."""

from __future__ import annotations

import re
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field

from raytruth.comparisons.renderers.program.declaration import Arithmetic, FeatureName, Formulas, Limits, Rays
from raytruth.comparisons.renderers.program.declared_part import Part
from raytruth.comparisons.renderers.program.model import Model
from raytruth.scenes.families.catalogue import FAMILIES
from raytruth.scenes.wording import quoted, suggestion

# A school's marks have at most a few thousand steps.
_MOST_POINTS = 1_000_000
# Seeds are only told apart; 2^31 - 1 is a whole number in every language.
_LARGEST_SEED = 2**31 - 1

Level = Literal["score", "topics", "scenes", "pixels", "diagnosis"]
"""How much a student is told, each more than the one before: the score; the points of each topic; the verdict on each
scene; where its pixels are wrong; and what mistake explains them."""
LEVELS: tuple[Level, ...] = ("score", "topics", "scenes", "pixels", "diagnosis")


def _usable_id(name: str) -> str:
    if re.fullmatch(r"[A-Za-z][A-Za-z0-9-]{0,39}", name) is None:
        raise ValueError("expected letters, digits and hyphens, at most 40, the first of them a letter")
    return name


def _a_family(name: str) -> str:
    if name not in FAMILIES:
        raise ValueError(f"there is no family {quoted(name)}; {suggestion(name, sorted(FAMILIES))}")
    return name


def _as_list(value: object) -> object:
    """One level for all attempts may stand without brackets."""
    return [value] if isinstance(value, str) else value


Identifier = Annotated[str, AfterValidator(_usable_id)]
Share = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, le=1)]
Weight = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0, le=_MOST_POINTS)]
Seed = Annotated[int, Field(strict=True, ge=0, le=_LARGEST_SEED)]


class AllowedModel(Part):
    """An arithmetic, shortcuts and formulas that a student's program may have, with the keys of a declaration."""

    arithmetic: Arithmetic = Field(Arithmetic(), description="As in a file that declares a program.")
    rays: Rays = Field(Rays(), description="As in a file that declares a program.")
    formulas: Formulas = Field(Formulas(), description="As in a file that declares a program.")
    model: Model = Field(Model(), description="As in a file that declares a program.")
    epsilon: float = Field(
        0.0,
        strict=True,
        allow_inf_nan=False,
        ge=0,
        le=1,
        description="Rays may start anywhere up to this far from the surface that they leave, in units of the scene: "
        "an offset of any size up to it. In place of [rays].",
    )


class FamilyScenes(Part):
    """Scenes of a family, one for each seed."""

    family: Annotated[str, AfterValidator(_a_family)] = Field(description="The family's name.")
    parameter: float = Field(strict=True, allow_inf_nan=False, description="The family's parameter.")
    seeds: tuple[Seed, ...] = Field(
        min_length=1, description="Added to the seed of a submission, so that each may have scenes of its own."
    )


class Topic(Part):
    """What is worth points: the scenes that show whether a student has understood it."""

    id: Identifier = Field(description="What its points are called in results; a clause or a chapter, or any word.")
    title: str = Field(min_length=1, description="What a student reads.")
    weight: Weight = Field(1.0, description="Its share of all points, beside the other topics' weights.")
    scenes: tuple[str, ...] = Field((), description="Scenes of the library, or paths from the assignment's folder.")
    families: tuple[FamilyScenes, ...] = Field((), description="Scenes that are drawn.")


class Stage(Part):
    """A date in the course: what a program need not have yet."""

    id: Identifier = Field(description="What --stage names it by.")
    without: tuple[FeatureName, ...] = Field(
        min_length=1,
        description="Scenes that require one of these features do not count; names as in a declaration.",
    )


class Assignment(Part):
    """All that a submission is graded by."""

    name: Identifier = Field(description="What the assignment is called in results.")
    title: str = Field(min_length=1, description="What a student reads.")
    points: Weight = Field(100.0, description="What a submission without a mistake gets.")
    partial_credit: Share = Field(
        0.5, description="What a scene is worth at most that has a wrong pixel: so much times the share of right ones."
    )
    declared_pixels: Share = Field(
        0.01, description="Which share of a scene's pixels may be right only by an epsilon or a departure."
    )
    global_charge: Share = Field(
        0.1,
        description="Which share of all points a mistake costs that alters every pixel alike, as a mirrored picture.",
    )
    full_size: Annotated[bool, Field(strict=True)] = Field(
        False, description="Whether scenes have their own size; if not, at most 300 pixels, which takes seconds."
    )
    limits: Limits = Field(Limits(), description="As in a file that declares a program, for each picture.")
    models: tuple[AllowedModel, ...] = Field(
        min_length=1, description="What a program's arithmetic may be: a pixel is right that one of them explains."
    )
    topics: tuple[Topic, ...] = Field(min_length=1, description="What is worth points.")
    stages: tuple[Stage, ...] = Field((), description="Dates in the course at which a part is due.")
    feedback: Annotated[tuple[Level, ...], BeforeValidator(_as_list)] = Field(
        ("diagnosis",),
        min_length=1,
        description="How much the student is told at the first attempt, at the second, …; the last holds from then on.",
    )

    def told(self, attempt: int) -> Level:
        """How much is told at this attempt, counted from 1."""
        return self.feedback[min(attempt, len(self.feedback)) - 1]
