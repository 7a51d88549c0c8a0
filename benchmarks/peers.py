"""Times the compiled tracer beside its peers: `python -m benchmarks.peers [--json] [--size N] [--rounds N]`.

Each renderer has a process of its own with the same processors; both render the same scene in turns, so that whatever
else the machine does meets both. A ratio is the peer's seconds over ours in one round; its median is given with a
confidence interval. Compilation is apart: it is in the seconds of the first rendering.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import platform
import statistics
import subprocess
import sys
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.peer_scenes import MIRROR_DEPTH, diffuse_scene, mirror_scene
from raytruth.comparisons.renderers.mitsuba.adapter import mitsuba_llvm
from raytruth.scenes.exporters.mitsuba import export_mitsuba

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.scenes.scene import Scene

THREADS = 2
SIZE = 512
ROUNDS = 21
# What the interval of a ratio covers, by convention.
CONFIDENCE = 0.95
# How far two right pictures in float64 and float32 may be apart on smooth surfaces with a single light.
CLOSE = 2e-5
TABLE_WIDTH = 120
REPOSITORY = Path(__file__).parents[1]


@dataclass(frozen=True)
class Ratio:
    """How long a peer takes for a picture over how long we take; `low` and `high` bound the median of the ratio."""

    name: str
    ours_seconds: float
    peer_seconds: float
    ratio: float
    low: float
    high: float
    ours_first_seconds: float
    """Until the first picture of a process that never saw the scene: compiling is the most of it."""
    peer_first_seconds: float
    ours_peak_bytes: int
    """The largest resident size of the process."""
    peer_peak_bytes: int
    pixels_apart: float
    """The share of pixels that differ by more than rounding does: those on edges."""


class Worker:
    """A process of benchmarks/timing_worker.py, which has rendered once within a `with`. RuntimeError if it dies."""

    def __init__(self, renderer: str, scene_file: Path, folder: Path) -> None:
        self.image_file = folder / f"{renderer}.npy"
        command = [sys.executable, "-P", "-m", "benchmarks.timing_worker"]
        self.process = subprocess.Popen(
            [*command, renderer, str(scene_file), str(THREADS), str(self.image_file)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            # A cache of its own: the first rendering compiles.
            env={**os.environ, "PYTHONPATH": str(REPOSITORY), "RAYTRUTH_CACHE": str(folder / "cache")},
        )
        self.first_seconds = math.nan

    def __enter__(self) -> Self:
        try:
            self.first_seconds = self._answer()["seconds"]
        except RuntimeError:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        with self.process:
            self.process.kill()

    def render(self) -> float:
        """The seconds of one more rendering."""
        assert self.process.stdin is not None
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        seconds: float = self._answer()["seconds"]
        return seconds

    def peak_bytes(self) -> int:
        """Ends the process and returns its largest resident size."""
        assert self.process.stdin is not None
        self.process.stdin.close()
        peak: int = self._answer()["peak_bytes"]
        return peak

    def _answer(self) -> Any:
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{' '.join(self.process.args)} ended without an answer")  # type: ignore[arg-type] # a list
        return json.loads(line)


def measure(name: str, scene: Scene, variant: str, integrator: str, max_depth: int, rounds: int) -> Ratio:
    """Time one scene in both; `max_depth` is Mitsuba's. Raises RuntimeError where a process dies."""
    with TemporaryDirectory(prefix="raytruth-") as temporary:
        folder = Path(temporary)
        scene_file = folder / "scene.json"
        scene_file.write_text(scene.model_dump_json(exclude_none=True), encoding="utf-8")
        peer_file = export_mitsuba(scene, folder, integrator=integrator, max_depth=max_depth)
        with Worker("raytruth", scene_file, folder) as ours, Worker(variant, peer_file, folder) as peer:
            times = [(ours.render(), peer.render()) for _ in range(rounds)]
            ratios = sorted(theirs / own for own, theirs in times)
            outside = ranks_outside(rounds)
            return Ratio(
                name,
                ours_seconds=statistics.median(own for own, _ in times),
                peer_seconds=statistics.median(theirs for _, theirs in times),
                ratio=statistics.median(ratios),
                low=ratios[outside],
                high=ratios[-1 - outside],
                ours_first_seconds=ours.first_seconds,
                peer_first_seconds=peer.first_seconds,
                ours_peak_bytes=ours.peak_bytes(),
                peer_peak_bytes=peer.peak_bytes(),
                pixels_apart=pixels_apart(ours.image_file, peer.image_file),
            )


def ranks_outside(count: int) -> int:
    """How many of the lowest, and of the highest, of `count` values lie outside the median's confidence interval.

    As many values lie below the median as a fair coin shows heads (Conover, Practical Nonparametric Statistics, 3.2);
    0 for counts too small for the confidence.
    """
    outside = 0
    below = 0.5**count
    while below <= (1 - CONFIDENCE) / 2:
        outside += 1
        below += math.comb(count, outside) * 0.5**count
    return max(0, outside - 1)


def pixels_apart(ours: Path, peer: Path) -> float:
    """The share of pixels of which some component differs by more than CLOSE."""
    difference = np.abs(np.load(ours) - np.load(peer)).max(axis=2)
    return float(np.mean(difference > CLOSE))


def measure_all(size: int, rounds: int) -> list[Ratio]:
    """Every scene beside every variant of Mitsuba that runs here."""
    variants = ["scalar_rgb", *(["llvm_ad_rgb"] if mitsuba_llvm().version() else [])]
    ratios = []
    for variant in variants:
        name = f"mitsuba {variant}"
        ratios.append(measure(f"{name} direct", diffuse_scene(size), variant, "direct", 2, rounds))
        mirrors = f"{name} path, {MIRROR_DEPTH} mirrors"
        # Mitsuba counts edges: one more than the surfaces on the way, of which the last one shines.
        ratios.append(measure(mirrors, mirror_scene(size), variant, "path", MIRROR_DEPTH + 2, rounds))
    return ratios


def document(ratios: Sequence[Ratio], size: int, rounds: int) -> dict[str, Any]:
    """What `--json` prints."""
    return {
        "machine": {**machine(), **{name: version(name) for name in ("mitsuba", "llvmlite")}},
        "ratios": [asdict(ratio) for ratio in ratios],
        "date": datetime.now(UTC).date().isoformat(),
        "threads": THREADS,
        "size": size,
        "rounds": rounds,
    }


def machine() -> dict[str, Any]:
    """What the times depend on, but for the versions of libraries."""
    return {
        "processor": _processor(),
        "processors": os.cpu_count(),
        "system": platform.platform(),
        "python": platform.python_version(),
    }


def _processor() -> str:
    names = [line for line in Path("/proc/cpuinfo").read_text("utf-8").splitlines() if line.startswith("model name")]
    return names[0].split(":")[1].strip() if names else platform.machine()


def print_table(ratios: Sequence[Ratio], size: int) -> None:
    """For a person."""
    table = Table(title=f"{size}x{size} pixels, {THREADS} threads each, one ray a pixel")
    for heading in ("peer", "ours [ms]", "peer [ms]", "peer / ours", "first [s]", "memory [MB]", "pixels apart"):
        table.add_column(heading, justify="left" if heading == "peer" else "right", no_wrap=True)
    for ratio in ratios:
        table.add_row(
            ratio.name,
            f"{ratio.ours_seconds * 1e3:.1f}",
            f"{ratio.peer_seconds * 1e3:.1f}",
            f"{ratio.ratio:.1f} ({ratio.low:.1f} to {ratio.high:.1f})",
            f"{ratio.ours_first_seconds:.1f} / {ratio.peer_first_seconds:.1f}",
            f"{ratio.ours_peak_bytes / 1e6:.0f} / {ratio.peer_peak_bytes / 1e6:.0f}",
            f"{ratio.pixels_apart:.2%}",
        )
    # Not narrower where it is not shown on a terminal.
    Console(width=None if sys.stdout.isatty() else TABLE_WIDTH).print(table)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure, then print a table or JSON."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.peers", description="Time the tracer beside its peers.")
    parser.add_argument("--json", action="store_true", help="print one JSON document instead of a table")
    parser.add_argument("--size", type=int, default=SIZE, help="width and height in pixels (default %(default)s)")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help="renderings of each scene (default %(default)s)")
    options = parser.parse_args(arguments)
    ratios = measure_all(options.size, options.rounds)
    if options.json:
        print(json.dumps(document(ratios, options.size, options.rounds), indent=2))
    else:
        print_table(ratios, options.size)


if __name__ == "__main__":
    main()
