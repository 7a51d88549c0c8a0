"""What a user declares of a program that is a renderer: the keys of its file, each told in a sentence."""

from __future__ import annotations

import re
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from raytruth.comparisons.renderers.program.conventions import Conventions
from raytruth.comparisons.renderers.program.declared_part import Part
from raytruth.comparisons.renderers.program.model import Model
from raytruth.scenes.features import Feature
from raytruth.scenes.values import NonNegative
from raytruth.scenes.wording import quoted, suggestion

PLACEHOLDERS = ("scene", "output", "first_hits", "width", "height", "depth", "seed", "samples", "folder")
"""What stands in braces in a command, and is replaced by a file's path, by a number, or by a folder's path."""

# A day: who lets a program run for longer watches it.
_MOST_SECONDS = 86_400
# A tebibyte, more than any machine that this runs on; of address space, of which some programs reserve very much.
_MOST_MEBIBYTES = 2**20
# The truth has no more bits to say than float64 has.
_MOST_BITS = 53
# A mean needs a spread that is told from few batches only roughly; hundreds say it to a few percent.
_FEWEST_BATCHES = 8
_MOST_BATCHES = 1000
# As many as any renderer takes in a batch of seconds.
_MOST_SAMPLES = 1_000_000


def _usable_name(name: str) -> str:
    if re.fullmatch(r"[a-z][a-z0-9-]{0,39}", name) is None:
        raise ValueError("expected lower-case letters, digits and hyphens, at most 40, the first of them a letter")
    return name


def _usable_variable(name: str) -> str:
    if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) is None:
        raise ValueError("expected the name of a variable: letters, digits and underscores")
    return name


def _without_nul(text: str) -> str:
    if "\0" in text:
        raise ValueError("expected a text without the character NUL, which no command can have")
    return text


def _with_known_placeholders(word: str) -> str:
    for name in re.findall(r"\{(\w*)\}", word):
        if name not in PLACEHOLDERS:
            raise ValueError(f"expected no placeholder {quoted(name)} in braces; {suggestion(name, PLACEHOLDERS)}")
    return word


def _a_pattern(pattern: str) -> str:
    parts = pattern.split("/")
    if not pattern or pattern.startswith("/") or any("**" in part and part != "**" for part in parts):
        told = "as src/**/*.py: from the folder of this file, with ** for folders of any depth"
        raise ValueError(f"expected a pattern {told}, found {quoted(pattern)}")
    return pattern


def _a_feature(name: str) -> str:
    known = [feature.lower() for feature in Feature]
    if name not in known:
        raise ValueError(f"there is no feature {quoted(name)}; {suggestion(name, known)}")
    return name


Text = Annotated[str, AfterValidator(_without_nul)]
Word = Annotated[Text, AfterValidator(_with_known_placeholders)]
Variable = Annotated[str, AfterValidator(_usable_variable)]
Pattern = Annotated[Text, AfterValidator(_a_pattern)]
FeatureName = Annotated[
    str, AfterValidator(_a_feature), Field(json_schema_extra={"enum": sorted(map(str.lower, Feature))})
]
Truth = Annotated[bool, Field(strict=True)]
Fraction = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0, lt=1)]


class Limits(Part):
    """What the program may take for one picture; if it takes more, it is ended, and its cell is an error."""

    seconds: float = Field(60.0, strict=True, gt=0, le=_MOST_SECONDS, description="Time for one picture.")
    memory_mib: int = Field(
        4096,
        strict=True,
        ge=1,
        le=_MOST_MEBIBYTES,
        description="Address space of each process, in MiB. Programs in Java, Go or JavaScript reserve far more than "
        "they use: give those 65536.",
    )
    output_mib: int = Field(
        256, strict=True, ge=1, le=_MOST_MEBIBYTES, description="Each file that the program writes, in MiB."
    )


class Scenes(Part):
    """Which scenes the program cannot render: their cells are incomparable, not failed."""

    refuses: tuple[FeatureName, ...] = Field(
        (), description="Features that the program does not have, by the names that `raytruth scenes list` shows."
    )


class Sampling(Part):
    """Random numbers, for a program that draws them."""

    samples: int = Field(
        0,
        strict=True,
        ge=0,
        le=_MOST_SAMPLES,
        description="How many samples each pixel has in one picture; 0 for a program that draws no random numbers.",
    )
    batches: int = Field(
        32,
        strict=True,
        ge=_FEWEST_BATCHES,
        le=_MOST_BATCHES,
        description="How many pictures are rendered, each with another {seed}; their mean is judged.",
    )


class Arithmetic(Part):
    """How exact the program's numbers are."""

    precision: Literal["float64", "float32"] | None = Field(
        None, description="The type of its numbers; if neither this nor bits is stated, 39 bits."
    )
    bits: int | None = Field(
        None,
        strict=True,
        ge=8,
        le=_MOST_BITS,
        description="In place of precision: one operation errs by at most 2 to the power of -bits of its result.",
    )
    slack_bits: int = Field(
        0,
        strict=True,
        ge=0,
        le=40,
        description="Bits of the precision that are left for another order of operations, fused multiply-adds, or "
        "formulas that are not named under [formulas].",
    )
    smallest: float = Field(
        0.0,
        strict=True,
        allow_inf_nan=False,
        ge=0,
        le=1,
        description="Numbers below this may be flushed to zero.",
    )


class LeavingRays(Part):
    """How rays of one kind leave a surface, where that is not as for all rays."""

    offset: NonNegative | None = Field(None, description="As under [rays].")
    relative_offset: Fraction | None = Field(None, description="As under [rays].")
    along: Literal["normal", "ray"] | None = Field(None, description="As under [rays].")
    least_distance: NonNegative | None = Field(None, description="As under [rays].")
    relative_least_distance: Fraction | None = Field(None, description="As under [rays].")
    own_surface: Literal["excluded", "tested"] | None = Field(None, description="As under [rays].")


class Rays(Part):
    """How rays leave a surface, and where they end."""

    offset: NonNegative = Field(0.0, description="How far beside the surface a ray starts, in units of the scene.")
    relative_offset: Fraction = Field(
        0.0, description="The same, as a fraction of the largest coordinate of the point; both are added."
    )
    along: Literal["normal", "ray"] = Field("normal", description="Into which direction the start is moved.")
    least_distance: NonNegative = Field(
        0.0, description="Hits nearer than this to a ray's start are ignored, in units of the scene (t_min)."
    )
    relative_least_distance: Fraction = Field(
        0.0, description="The same, as a fraction of the largest coordinate of the ray's start."
    )
    own_surface: Literal["excluded", "tested"] | None = Field(
        None,
        description="Whether the sphere or triangle that a ray leaves is left out of its search, or tested as all "
        "others are. Unless stated: tested with a least distance or an offset along the ray, else excluded.",
    )
    shadow_shortening: Fraction = Field(
        0.0, description="At which fraction of the light's distance before the light a shadow ray ends."
    )
    shadow_aim: Literal["light", "parallel", "either"] | None = Field(
        None,
        description="Where a shadow ray goes that starts beside the surface: from there to the light, or parallel to "
        "the way from the surface; by default either.",
    )
    shadow: LeavingRays | None = Field(None, description="What is otherwise for rays to lights.")
    reflected: LeavingRays | None = Field(None, description="What is otherwise for reflected rays.")
    refracted: LeavingRays | None = Field(None, description="What is otherwise for refracted rays.")


class Formulas(Part):
    """By which formulas the program finds hits and splits light; `raytruth renderers --formulas` shows their code."""

    sphere: Literal["quadratic", "stable quadratic", "geometric", "accurate"] = Field(
        "accurate", description="Where a ray meets a sphere."
    )
    triangle: Literal["moeller-trumbore", "cramer", "plane and inside", "watertight", "pluecker"] = Field(
        "watertight", description="Whether a ray meets a triangle."
    )
    least_determinant: NonNegative = Field(
        0.0,
        description="Triangles are missed whose determinant in Möller and Trumbore's test is nearer to 0 than this: "
        "their EPSILON, 0.000001 in the paper.",
    )
    triangle_points: Literal["along the ray", "barycentric"] = Field(
        "along the ray", description="How the point on a triangle is found: from the distance, or from the corners."
    )
    sphere_normals: Literal["divided", "normalised"] = Field(
        "divided", description="(p - c)/r, or p - c made a unit vector."
    )
    fresnel: Literal["accurate", "as specified", "cosines"] = Field(
        "accurate",
        description="How Fresnel's equations are evaluated: without any cancellation, as REFR-4 of the specification "
        "is written, or from two cosines.",
    )
    refraction: Literal["accurate", "as specified", "heckbert", "bec"] = Field(
        "accurate",
        description="How the refracted direction is found, and whether there is one: without any cancellation, as "
        "REFR-2 and REFR-3 are written, or by Heckbert's or Bec's formula.",
    )
    directions: Literal["normalised", "unnormalised"] | None = Field(
        None,
        description="Whether rays that leave a surface are made unit vectors once more, or least distances are "
        "compared with t in units of the direction's own length; by default directions are as the specification's "
        "formulas give them, and least distances are lengths.",
    )


class Declaration(Part):
    """A program as a renderer."""

    name: Annotated[str, AfterValidator(_usable_name)] = Field(description="The name of its column in the matrix.")
    command: tuple[Word, ...] = Field(
        min_length=1,
        description="The program and its arguments, a list of words that no shell sees. A word that names a file is "
        "found from the folder of this file. {scene} and {output} are the files to read and to write; {first_hits} a "
        "second picture to write, of what is seen first; {width}, {height}, {depth}, {samples} and {seed} are numbers; "
        "{folder} is the folder of this file.",
    )
    files: tuple[Pattern, ...] | None = Field(
        None,
        description="Patterns of files that the program consists of besides those that its command names, as "
        "'src/**/*.py' or '*.glsl', from the folder of this file: when one changes, the program is judged anew. "
        "By default all files with the ending of a script that the command names, in its folder and below.",
    )
    version: tuple[Word, ...] = Field((), description="A command whose first line of output is the version.")
    reads: Literal["json", "obj", "mitsuba", "povray", "gltf", "pbrt"] = Field(
        "json", description="What a scene is written as for the program, as by `raytruth scenes export`."
    )
    writes: Literal["exr", "pfm", "hdr", "ppm", "png"] = Field("exr", description="The format of its picture.")
    numbers: Literal["uint8", "uint16", "half", "float"] | None = Field(
        None, description="What the picture holds, if not float in EXR and PFM, or uint8 in PPM and PNG."
    )
    colours: Literal["linear", "srgb"] = Field(
        "linear", description="Whether the numbers are linear, or encoded by the curve of sRGB."
    )
    rounding: Literal["nearest", "truncated"] = Field(
        "nearest", description="How whole numbers come about: 255·x + 0.5 cut off, or 255·x cut off."
    )
    clipped: Truth | None = Field(
        None, description="Whether colours above 1 are written as 1, as whole numbers always are."
    )
    environment: dict[Variable, Text] = Field({}, description="Variables of the environment that it runs in.")
    reference: Truth = Field(
        False,
        description="Whether it is an independent reference, so that scenes on which it passes count as confirmed by "
        "it. A program under test confirms nothing.",
    )
    family: Annotated[str, AfterValidator(_usable_name)] | None = Field(
        None, description="Of references: those of one family share code, and are one opinion; by default the name."
    )
    limits: Limits = Limits()
    scenes: Scenes = Scenes()
    sampling: Sampling = Sampling()
    arithmetic: Arithmetic = Arithmetic()
    rays: Rays = Rays()
    formulas: Formulas = Formulas()
    conventions: Conventions = Conventions()
    model: Model = Model()

    def uses(self, placeholder: str) -> bool:
        """Whether its command has this placeholder."""
        return any(f"{{{placeholder}}}" in word for word in self.command)
