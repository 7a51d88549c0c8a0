"""The results of the kill matrix, as `faults.json` holds them: the contract between judging and showing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.records.results import Record

if TYPE_CHECKING:
    from pathlib import Path

KILLS_FILE = "faults.json"


class SubjectResult(Record):
    """What came of a fault or of a legitimate variant on all scenes."""

    name: str
    words: str
    margins: dict[str, float | None]
    """By scene, where it differs from the right tracer: the largest distance in tolerances, up to 1 for a pass; None
    where that is infinite."""
    errors: dict[str, str]
    """For each scene on which that happened: what it raised, or what is wrong with the whole image."""
    gates: tuple[str, ...]
    """The gates of public suites that reject it on any scene."""

    @property
    def failed_on(self) -> list[str]:
        """The scenes on which it fails."""
        return [scene for scene, margin in self.margins.items() if margin is None or margin > 1]

    @property
    def largest_margin(self) -> float | None:
        """The largest margin over all scenes, in tolerances; None if one is infinite."""
        finite = [margin for margin in self.margins.values() if margin is not None]
        return None if len(finite) < len(self.margins) else max(finite, default=0.0)


class FaultResult(SubjectResult):
    """A fault, and whether it is found."""

    clause: str
    hint: str
    killed: bool
    killed_by: tuple[str, ...]
    margin: float | None


class VariantResult(SubjectResult):
    """A legitimate variant, and whether it is taken for wrong."""

    flagged: bool


class KillResults(Record):
    """The kill matrix: all faults and legitimate variants, and what judged them."""

    schema_version: int = 1
    faults: tuple[FaultResult, ...]
    variants: tuple[VariantResult, ...]
    seconds: float
    scenes: dict[str, float]
    """Name, and the seconds that it takes to judge one renderer by it."""
    gates: tuple[str, ...]
    quick: tuple[str, ...]
    """The scenes that together kill every fault that any scene kills, in the least time."""

    @property
    def survivors(self) -> list[str]:
        """Faults that no scene kills."""
        return [fault.name for fault in self.faults if not fault.killed]

    @property
    def false_alarms(self) -> list[str]:
        """Variants that some scene flags."""
        return [variant.name for variant in self.variants if variant.flagged]


def read_kill_results(directory: Path) -> KillResults:
    """The kill matrix in a results directory. Raises OSError where there is none, ValueError where it is damaged."""
    return KillResults.model_validate_json((directory / KILLS_FILE).read_text(encoding="utf-8"))
