"""The results format: the only contract between judging and showing.

A results directory holds `results.json` (this model) and, in `cells/SCENE/RENDERER-INTEGRATOR/`, the images of each
cell as float32 EXR. Paths in the file are relative to the directory.
"""

from __future__ import annotations

from collections import Counter
from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

SCHEMA_VERSION = 1
RESULTS_FILE = "results.json"


class Verdict(StrEnum):
    """What a cell can be; only `error`, and `fail` where it is not waived, make a run fail.

    A cell is `declared` where all its pixels are feasible, but some only by a shortcut that the renderer declares, and
    a person could see that they are not what is due.
    """

    PASS = "pass"
    DECLARED = "declared"
    FAIL = "fail"
    INCOMPARABLE = "incomparable"
    UNAVAILABLE = "unavailable"
    ERROR = "error"


class Record(BaseModel):
    """A part of the results: immutable, and without keys that it does not know."""

    # Infinity and not-a-number are results, too: JSON has no numbers for them, so they are written as strings.
    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="strings")


class Metrics(Record):
    """Global measures of difference from the truth, for information: never the gate. None: could not be computed."""

    largest_difference: float | None = Field(None, title="Largest difference")
    mean_difference: float | None = Field(None, title="Mean difference (bias)")
    """Signed, so that a bias shows."""
    rmse: float | None = Field(None, title="RMSE")
    relative_mse: float | None = Field(None, title="Relative MSE")
    psnr: float | None = Field(None, title="PSNR [dB]")
    """Decibels relative to the truth's largest value; None for identical images, too."""
    ssim: float | None = Field(None, title="SSIM")
    flip: float | None = Field(None, title="FLIP")
    delta_e_2000: float | None = Field(None, title="Largest ΔE2000")
    """Largest CIE ΔE2000 of the sRGB pictures."""

    def by_title(self) -> dict[str, float | None]:
        """Each measure by the title that it has in a report."""
        return {str(field.title): getattr(self, name) for name, field in Metrics.model_fields.items()}


class WorstPixel(Record):
    """The pixel farthest outside its feasible set, in units of that pixel's tolerance."""

    x: int
    y: int
    value: tuple[float, float, float]
    truth: tuple[float, float, float]
    low: tuple[float, float, float]
    """The ends of the nearest outcome's box, channel by channel."""
    high: tuple[float, float, float]
    tolerances: float
    """Distance from the middle of the nearest outcome in units of the tolerance: above 1 the pixel fails."""


class DeclaredPixels(Record):
    """Pixels that are as declared, not as due: only a shortcut explains them, and one could see it."""

    count: int
    largest_difference: float
    """How far the farthest channel of any of them is from the truth, linear."""
    pixels: tuple[tuple[int, int], ...]
    """Column and row, the farthest from the truth first; not all of them where there are very many."""


class Judgement(Record):
    """How many pixels of an image fared how, and the worst of them."""

    pixels: int
    failing: int
    unjudged: int
    """Pixels of which the renderer's arithmetic leaves everything open."""
    capped: int
    """Judged pixels with more outcomes than are told apart: one box holds several."""
    ambiguous: int
    """Pixels where the renderer's arithmetic allows more than one outcome (edges, shadow boundaries)."""
    declared: DeclaredPixels | None = None
    """None where every feasible pixel is as due, or looks so."""
    worst: WorstPixel | None = None


class StochasticTest(Record):
    """What the test of a noisy image's means against the truth was, and what it found."""

    samples: int
    batches: int
    significance: float
    """Probability that a right renderer fails this cell, at most."""
    smallest_p_value: float
    """After correction for the number of tests."""


class FirstHitComparison(Record):
    """How first hits of the very same rays compare; the largest errors are over pixels whose primitive is certain."""

    compared: int
    unjudged: int = 0
    """Pixels whose first hit the renderer's arithmetic leaves open."""
    declared: int = 0
    """First hits that only a declared shortcut explains."""
    primitive_mismatches: int
    ambiguous: int
    """Pixels where float32 may hit either of two primitives, or miss."""
    largest_depth_error: float
    largest_position_error: float
    largest_normal_error: float
    failing: int


class Images(Record):
    """Paths of a cell's images, relative to the results directory."""

    render: str
    truth: str
    tolerances: str
    """Each channel's distance from the middle of the nearest outcome, in units of the tolerance; -1 where unjudged."""
    feasible: str
    """What each pixel is held to: channels and their meaning in pixel_evidence.py."""
    variance: str | None = None
    digest: str = ""
    """Of the content of all these files (whole_cells.py): a cell whose images are others is not taken over."""

    @property
    def paths(self) -> list[str]:
        """All of them, always in the same order."""
        return [path for path in (self.render, self.truth, self.tolerances, self.feasible, self.variance) if path]


Link = Annotated[str, Field(pattern=r"^https://[^\s]+$")]
"""An address that a browser may open."""


class Waived(Record):
    """Why a failure is known, and does not make the run fail."""

    reason: str
    link: Link


class Cell(Record):
    """One scene on one integrator of one renderer: its verdict, and what that rests on."""

    scene: str
    renderer: str
    integrator: str
    verdict: Verdict
    reason: str
    waived: Waived | None = None
    """The waiver that tells of this failure; the verdict is still `fail`. None where none does."""
    largest_error: float | None = None
    """Over the judged pixels: from the truth, or from the nearest outcome that is due where there are several."""
    seconds: float | None = None
    """Wall-clock time of the renderer alone, without its start."""
    version: str | None = None
    judgement: Judgement | None = None
    stochastic: StochasticTest | None = None
    first_hits: FirstHitComparison | None = None
    metrics: Metrics | None = None
    images: Images | None = None
    log: str | None = None
    """Path of the renderer's log, relative to the results directory."""
    command: str
    """The command that repeats this cell."""
    source: str | None = None
    """What names the scene on the command line: its library name or its path."""
    key: str = ""
    """Hash of all the cell depends on; a cell with the same key need not be run again."""

    @property
    def folder(self) -> str:
        """Where its files lie if it was rendered, relative to the results directory."""
        return f"cells/{self.scene}/{self.renderer}-{self.integrator}"


class SceneRecord(Record):
    """What the report says of a scene."""

    name: str
    purpose: str
    convention: str
    width: int
    height: int
    features: tuple[str, ...]
    light_paths: str
    """The scene's own light paths in Heckbert's notation."""


class RendererRecord(Record):
    """What the report says of a renderer."""

    name: str
    version: str | None
    """None where it is not available."""
    install: str
    """One line that says how to install it."""
    error_model: str
    integrators: dict[str, str]
    """Light-path class of each integrator, in Heckbert's notation."""
    family: str | None = None
    """Renderers of one family share code and are one opinion. None: no independent reference, since it shares the
    truth's own source, or is a user's program under test."""


class Results(Record):
    """What `results.json` holds: all cells of a run, their scenes and their renderers."""

    schema_version: int = SCHEMA_VERSION
    raytruth_version: str
    created: str
    command: str
    machine: dict[str, str]
    scenes: tuple[SceneRecord, ...]
    renderers: tuple[RendererRecord, ...]
    cells: tuple[Cell, ...]


def inconsistency(results: Results) -> str | None:
    """What is wrong with the lists, as a clause: each cell must have its row and column, and all only once.

    Else the matrix would hide a cell. None if nothing is wrong.
    """
    scenes = {scene.name for scene in results.scenes}
    renderers = {renderer.name for renderer in results.renderers}
    for cell in results.cells:
        if cell.scene not in scenes:
            return f"has a cell of the scene {cell.scene!r}, which its list of scenes lacks"
        if cell.renderer not in renderers:
            return f"has a cell of the renderer {cell.renderer!r}, which its list of renderers lacks"
    names = {
        "scene": [scene.name for scene in results.scenes],
        "renderer": [renderer.name for renderer in results.renderers],
        "cell": [f"{cell.scene} {cell.renderer}/{cell.integrator}" for cell in results.cells],
    }
    for kind, listed in names.items():
        for name, count in Counter(listed).items():
            if count > 1:
                return f"lists the {kind} {name!r} {count} times; expected once"
    return None
