"""A renderer that misbehaves on purpose: its program does the misdeed, and it reads the result as an adapter does."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.processes.worker_results import read_arrays
from raytruth.comparisons.records.renderings import Rendering
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.light_paths import WHITTED

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Rays
    from raytruth.scenes.scene import Scene

# A misdeed takes a second. Only the one that never ends needs a short limit: others may be slow on a busy machine.
TIME_LIMIT = 60.0
HANGING_LIMIT = 5.0
LOG_LIMIT = 1 << 16
FILE_LIMIT = 1 << 20
MEMORY_LIMIT = 4 << 30

# What every misdeed begins with: a scratch file elsewhere, a last word, and a way to write a right-looking result.
BEGINNING = """
import ctypes, os, signal, sys, tempfile, time
import numpy as np
HEIGHT, WIDTH = int(sys.argv[1]), int(sys.argv[2])
temporary = tempfile.NamedTemporaryFile(delete=False)
print("last words", flush=True)
def write(height=HEIGHT, width=WIDTH, value=0.5):
    np.savez("result.npz", image=np.full((height, width, 3), value, dtype=np.float32))
"""

SLEEPER = """
for escape in (False, True):
    if os.fork() == 0:
        if escape:
            os.setsid()
        print("child", os.getpid(), flush=True)
        time.sleep(600)
time.sleep(0.2)
"""

MISDEEDS = {
    "behaves": ("write()", ""),
    "aborts": ("write(); os.abort()", "SIGABRT"),
    "segmentation fault": ("write(); ctypes.string_at(0)", "SIGSEGV"),
    "hangs": (
        SLEEPER + "write(); signal.signal(signal.SIGTERM, signal.SIG_IGN)\nwhile True: pass",
        "time limit of 5 s",
    ),
    "wrong size": ("write(height=WIDTH + 1)", "expected an image of shape"),
    "not a number": ("write(value=np.nan)", "not a number"),
    "no output": ("", "cannot be read"),
    "truncated output": ("write(); os.truncate('result.npz', os.path.getsize('result.npz') // 2)", "cannot be read"),
    "endless log": (
        "for _ in range(10 * 1024): print('garbage' * 150_000 + '\\nlast words', flush=True)",
        "printed more than 65536 bytes",
    ),
    "leaves children": (SLEEPER + "write()", "left 2 processes behind"),
    "endless file": ("write()\nwith open('big', 'wb') as f:\n  while True: f.write(bytes(1 << 16))", "File too large"),
}
"""By name: what the program does, and a part of the reason that the cell must give."""


@dataclass
class AbusiveRenderer:
    """Obeys the protocol Renderer; a misdeed stands for an integrator, so that one run has them all."""

    name: str = "abusive"
    install: str = "better not"
    error_models: tuple[tuple[str, ErrorModel], ...] = (("*", ErrorModel("float32", precision_bits=24)),)
    integrators: tuple[Integrator, ...] = tuple(Integrator(name, WHITTED, has_depth=True) for name in MISDEEDS)

    def version(self) -> str | None:
        """Never asked in a process of its own."""
        return "abusive 1"

    def refuses(self, scene: Scene) -> str | None:  # noqa: ARG002 - the protocol's signature
        """Nothing."""
        return None

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - as above
        """Commit the misdeed."""
        size = [str(number) for number in rays.origins.shape[:2]]
        command = [sys.executable, "-c", BEGINNING + MISDEEDS[integrator][0], *size]
        run_isolated(
            command,
            folder,
            seconds=HANGING_LIMIT if integrator == "hangs" else TIME_LIMIT,
            memory_bytes=MEMORY_LIMIT,
            output_bytes=LOG_LIMIT,
            file_bytes=FILE_LIMIT,
        )
        return Rendering(read_arrays(folder / "result.npz", {}, "The program")["image"], 0.0)
