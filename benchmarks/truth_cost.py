"""What a proven pixel costs: `python -m benchmarks.truth_cost [--json] [--rounds N]`.

Four arithmetics take turns on the same scene in one process, on one processor: the compiled balls that prove most
pixels, Arb's balls, interpreted Python floats, and compiled float64. A ratio is the seconds of the compiled balls over
the other's in one round.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table

from benchmarks.peers import TABLE_WIDTH, machine, ranks_outside
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT
from raytruth.reference_tracer.certification import Certifier
from raytruth.reference_tracer.compiled_truth import CompiledTruth
from raytruth.reference_tracer.rendering import prepare
from raytruth.scenes.library import open_scene

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from raytruth.scenes.scene import Scene

# One sphere; a tree of mirrors and glass; a slab, whose trees are the largest; a mesh in a tree of boxes.
SCENES = ("single-sphere", "whitted-1980", "glass-slab", "trefoil-knot")
ROUNDS = 11
# Every eighth column and row: the pixels of a round are few, and lie all over the image.
STRIDE = 8


@dataclass(frozen=True)
class Cost:
    """Seconds a pixel of the compiled truth and of another arithmetic; `low` and `high` bound their ratio's median."""

    name: str
    truth_seconds: float
    other_seconds: float
    ratio: float
    low: float
    high: float


def measure(name: str, rounds: int) -> list[Cost]:
    """Time one scene of the library; kernels are made, and compiled, before."""
    scene = open_scene(name)
    ways = {
        "compiled balls": _truth(scene),
        "Arb's balls": _arb(scene),
        "interpreted float": _interpreted(scene),
        "compiled float64": _compiled(scene),
    }
    times = [[seconds() for seconds in ways.values()] for _ in range(rounds + 1)][1:]
    truth, *others = zip(*times, strict=True)
    names = [way for way in ways if way != "compiled balls"]
    return [_cost(f"{name}, {other}", truth, seconds) for other, seconds in zip(names, others, strict=True)]


def _cost(name: str, truth: Sequence[float], other: Sequence[float]) -> Cost:
    ratios = sorted(ours / theirs for ours, theirs in zip(truth, other, strict=True))
    outside = ranks_outside(len(ratios))
    return Cost(
        name,
        truth_seconds=statistics.median(truth),
        other_seconds=statistics.median(other),
        ratio=statistics.median(ratios),
        low=ratios[outside],
        high=ratios[-1 - outside],
    )


def _pixels(scene: Scene) -> list[tuple[int, int]]:
    camera = scene.camera
    return [(column, row) for row in range(0, camera.height, STRIDE) for column in range(0, camera.width, STRIDE)]


def _truth(scene: Scene) -> Callable[[], float]:
    """Whole images, as of compiled float64."""
    truth = CompiledTruth(scene, Certifier(scene).frame())

    def seconds() -> float:
        start = time.process_time()
        truth.rows(0, scene.camera.height)
        return (time.process_time() - start) / (scene.camera.width * scene.camera.height)

    return seconds


def _arb(scene: Scene) -> Callable[[], float]:
    certifier = Certifier(scene)
    return lambda: _seconds_each(certifier.pixel, _pixels(scene))


def _interpreted(scene: Scene) -> Callable[[], float]:
    prepared = prepare(scene, FLOAT)
    frame = prepared.kernel.camera_frame(prepared.data)
    radiance_at = prepared.kernel.radiance_at
    return lambda: _seconds_each(
        lambda column, row: radiance_at(prepared.data, frame, column + 0.5, row + 0.5), _pixels(scene)
    )


def _compiled(scene: Scene) -> Callable[[], float]:
    """Whole images: a compiled kernel is entered once for many rows."""
    prepared = prepare(scene)
    width, height = scene.camera.width, scene.camera.height
    image = prepared.arithmetic.image(height, width, 3)

    def seconds() -> float:
        start = time.process_time()
        prepared.kernel.render_rows(prepared.data, 1, 0, height, image)
        return (time.process_time() - start) / (width * height)

    return seconds


def _seconds_each(evaluate: Callable[[int, int], object], pixels: Sequence[tuple[int, int]]) -> float:
    start = time.process_time()
    for pixel in pixels:
        evaluate(*pixel)
    return (time.process_time() - start) / len(pixels)


def document(costs: Sequence[Cost], rounds: int) -> dict[str, Any]:
    """What `--json` prints."""
    return {
        "machine": {**machine(), **{name: version(name) for name in ("python-flint", "llvmlite")}},
        "ratios": [asdict(cost) for cost in costs],
        "date": datetime.now(UTC).date().isoformat(),
        "rounds": rounds,
    }


def print_table(costs: Sequence[Cost]) -> None:
    """For a person."""
    table = Table(title="Processor time of a pixel")
    for heading in ("scene, beside", "truth [µs]", "other [µs]", "truth / other"):
        table.add_column(heading, justify="left" if heading == "scene, beside" else "right", no_wrap=True)
    for cost in costs:
        table.add_row(
            cost.name,
            f"{cost.truth_seconds * 1e6:.1f}",
            f"{cost.other_seconds * 1e6:.2f}",
            f"{cost.ratio:.3g} ({cost.low:.3g} to {cost.high:.3g})",
        )
    # Not narrower where it is not shown on a terminal.
    Console(width=None if sys.stdout.isatty() else TABLE_WIDTH).print(table)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure, then print a table or JSON."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.truth_cost", description="Time the proof of a pixel.")
    parser.add_argument("--json", action="store_true", help="print one JSON document instead of a table")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help="turns of each arithmetic (default %(default)s)")
    options = parser.parse_args(arguments)
    costs = [cost for name in SCENES for cost in measure(name, options.rounds)]
    if options.json:
        print(json.dumps(document(costs, options.rounds), indent=2))
    else:
        print_table(costs)


if __name__ == "__main__":
    main()
