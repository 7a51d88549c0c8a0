"""The ladder of sandboxes on this machine: what each rung holds, as tried, and which one is taken."""

from __future__ import annotations

import hashlib
import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from pydantic import ValidationError

from raytruth.comparisons.attacks.attacks import ATTACKS, attacked, behaves
from raytruth.comparisons.attacks.grader import attacked_grader
from raytruth.comparisons.records.sandbox_results import RungResult
from raytruth.comparisons.sandboxes.sandbox import RUNGS, SandboxError, is_root, missing_for
from raytruth.reference_tracer.storage.cache import cache_folder, keep

if TYPE_CHECKING:
    from raytruth.comparisons.sandboxes.sandbox import Rung

Choice = Literal["auto", "bubblewrap", "landlock", "user", "none"]
CHOICES: tuple[Choice, ...] = ("auto", *RUNGS, "none")

_UNHELD = "it runs with all rights of the user that grades it, within limits of time, memory, output and processes"


def tried(rung: Rung) -> RungResult:
    """Try all attacks on a rung, which takes some seconds."""
    missing = missing_for(rung)
    if missing is not None:
        return RungResult(rung=rung, works=False, reason=missing)
    try:
        with attacked_grader() as grader:
            failure = behaves(rung, grader)
            if failure:
                return RungResult(rung=rung, works=False, reason=failure)
            return RungResult(rung=rung, works=True, attacks=tuple(attacked(name, rung, grader) for name in ATTACKS))
    except SandboxError as error:
        return RungResult(rung=rung, works=False, reason=str(error))


def result_of(rung: Rung) -> RungResult:
    """What came of the attacks when they were last tried on this machine as it is, else now."""
    kept = cache_folder() / "sandboxes" / f"{rung}-{_machine()}.json"
    try:
        return RungResult.model_validate_json(kept.read_text(encoding="utf-8"))
    except (OSError, ValidationError):  # not tried yet, or not by this version
        result = tried(rung)
        if missing_for(rung) is None:
            keep(kept, lambda path: path.write_text(result.model_dump_json(indent=1), encoding="utf-8"))
        return result


def chosen(choice: Choice) -> RungResult:
    """The rung that is chosen or, for auto, the first one that works.

    Where none does, auto is none, unless we are root. Raises SandboxError where the choice does not work, and for none
    where we are root.
    """
    if choice == "none" and is_root():
        raise SandboxError("a program of others never runs as root; choose another sandbox, or be another user")
    if choice == "none":
        return RungResult(rung="none", works=True, reason=_UNHELD)
    results = []
    for rung in RUNGS if choice == "auto" else (choice,):
        results.append(result_of(rung))
        if results[-1].works:
            return results[-1]
    reasons = "; ".join(f"{it.rung}: {it.reason}" for it in results)
    if choice != "auto" or is_root():
        raise SandboxError(f"no sandbox works here that a program of others may run in ({reasons})")
    return RungResult(rung="none", works=True, reason=f"{_UNHELD} ({reasons})")


def _machine() -> str:
    """What the attacks' results depend on: the system since it was started, our rights in it, and the software."""
    parts = [platform.release(), str(os.geteuid()), os.environ.get("PATH", "")]
    parts += [Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii")]
    parts += [str(Path(f"/proc/self/ns/{name}").readlink()) for name in ("mnt", "user", "pid", "net", "cgroup")]
    status = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
    parts += [line for line in status if line.startswith(("CapEff", "NoNewPrivs", "Seccomp"))]
    parts += [_version(name) for name in ("raytruth", "landlockpy", "seccompy")]
    for folder in (Path(__file__).parent, Path(__file__).parent.parent / "sandboxes"):
        parts += [path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.py"))]
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "missing"
