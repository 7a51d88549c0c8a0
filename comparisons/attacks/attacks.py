"""Tries the attacks on a rung: which there are, what each is given, and how it is seen whether it was held."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from raytruth.comparisons.processes.isolation import LOG_FILE, run_isolated
from raytruth.comparisons.processes.removal import remove
from raytruth.comparisons.records.renderings import RendererError
from raytruth.comparisons.records.sandbox_results import AttackResult
from raytruth.comparisons.sandboxes.sandbox import Sandbox

if TYPE_CHECKING:
    from collections.abc import Callable

    from raytruth.comparisons.attacks.grader import Grader
    from raytruth.comparisons.sandboxes.sandbox import Rung

MEBIBYTE = 1 << 20
# Enough for a Python interpreter and what it is to be refused; little enough to be filled in a moment.
MEMORY_BYTES = 256 * MEBIBYTE
FILE_BYTES = MEBIBYTE
OUTPUT_BYTES = MEBIBYTE
# More than one process that behaves needs, with those that a sandbox itself is made of.
PROCESSES = 32
# For an attack that is to end by itself, on a busy machine; and for one that never does.
SECONDS = 20.0
SPINNING_SECONDS = 1.0
_SCENE = '{"scene": "to be read"}'
_PROGRAM = Path(__file__).with_name("attack_program.py")
_COPY = _PROGRAM.name
"""In the work folder, since ours may lie where no other user may read it."""


@dataclass(frozen=True)
class Attack:
    """One of the attacks of attack_program.py."""

    title: str
    values: Callable[[Grader], dict[str, Any]] = lambda _: {}
    limit: str = ""
    """What the limit that ends it says of it."""
    seconds: float = SECONDS
    reached: Callable[[Grader], str] = lambda _: ""
    """What the grader sees of its success afterwards, in a clause."""


ATTACKS: dict[str, Attack] = {
    "fork_bomb": Attack("a fork bomb", lambda _: {"processes": PROCESSES}),
    "memory_of_one": Attack("memory without end in one process", lambda _: {"memory": MEMORY_BYTES}),
    "memory_of_all": Attack(
        "memory without end in many processes", lambda _: {"memory": MEMORY_BYTES}, limit="of memory in all"
    ),
    "one_file": Attack("a file without end", lambda _: {"file": FILE_BYTES}),
    "many_files": Attack("files without end", lambda _: {"file": FILE_BYTES}, limit="wrote more than"),
    "shared_folders": Attack("files in folders that are everybody's", lambda grader: {"token": grader.token}),
    "processor": Attack("processor time without end", limit="time limit", seconds=SPINNING_SECONDS),
    "output": Attack("output without end", limit="printed more than"),
    "escape": Attack(
        "escape from the process group and session",
        lambda grader: {"token": grader.token},
        limit="left 1 process behind",
        reached=lambda grader: grader.survivors(),
    ),
    "network": Attack(
        "the network",
        lambda grader: {"port": grader.port, "token": grader.token},
        reached=lambda grader: grader.connections(),
    ),
    "truth": Attack("reading the truth", lambda grader: grader.file("truth")),
    "rubric": Attack("reading the rubric", lambda grader: grader.file("rubric")),
    "others": Attack("reading other submissions", lambda grader: grader.file("others")),
    "home": Attack("reading the home folder", lambda grader: grader.file("home")),
    "looking_into_the_grader": Attack(
        "looking into the grader's processes",
        lambda grader: {"pid": grader.process, "token": grader.token, "address": grader.address},
    ),
    "rewriting": Attack("rewriting results", lambda grader: grader.file("results"), reached=lambda it: it.rewritten()),
    "signals": Attack(
        "signals to the grader", lambda grader: {"pid": grader.process}, reached=lambda grader: grader.ended()
    ),
    "links": Attack("links in the output folder", lambda grader: grader.file("private"), limit="its picture is a link"),
    "becoming_root": Attack("becoming root"),
}
"""By the name of the function that makes the attack."""

# Several attacks are one function with other values.
_FUNCTIONS = dict.fromkeys(("truth", "rubric", "others", "home"), "reading")


def attacked(name: str, rung: Rung | None, grader: Grader) -> AttackResult:
    """What comes of one attack on a rung, or in no sandbox. Raises SandboxError where that cannot be set up."""
    attack = ATTACKS[name]
    if _FUNCTIONS.get(name) == "reading" and name not in grader.files:
        return AttackResult(attack=attack.title, result="not tried", detail="there is no folder to put a file into")
    words = _FUNCTIONS.get(name, name)
    failure, last = in_sandbox(words, attack.values(grader), rung, grader, attack.seconds)
    reached = attack.reached(grader) or _told_in_log(name, grader, failure)
    told = last.removeprefix("not held: ") if last.startswith("not held: ") else reached
    if told:
        return AttackResult(attack=attack.title, result="not enforced", detail=told)
    if attack.limit and attack.limit in failure:
        return AttackResult(attack=attack.title, result="held", detail=failure.partition("; ")[0])
    if last == "held" and (not failure or name == "escape"):
        return AttackResult(attack=attack.title, result="held", detail="")
    return AttackResult(attack=attack.title, result="not tried", detail=failure or f"it said {last!r}")


def behaves(rung: Rung, grader: Grader) -> str:
    """Why a program that behaves cannot run on this rung, in a clause; empty if it can. Raises SandboxError."""
    values = {"scene": str(grader.work.resolve() / "scene.json"), "memory": MEMORY_BYTES}
    failure, last = in_sandbox("behaving", values, rung, grader, SECONDS)
    return failure or ("" if last == "held" else last)


def in_sandbox(
    words: str, values: dict[str, Any], rung: Rung | None, grader: Grader, seconds: float
) -> tuple[str, str]:
    """Run a function of the attacking program in a new work folder: how it failed, and its last line."""
    remove(grader.work)
    grader.work.mkdir()
    (grader.work / "scene.json").write_text(_SCENE, encoding="utf-8")
    program = grader.work / _COPY
    program.write_bytes(_PROGRAM.read_bytes())
    command = [str(grader.python), "-I", "-S", str(program.resolve()), words, json.dumps(values)]
    failure = ""
    try:
        run_isolated(
            command,
            grader.work,
            seconds=seconds,
            memory_bytes=MEMORY_BYTES,
            output_bytes=OUTPUT_BYTES,
            file_bytes=FILE_BYTES,
            sandbox=Sandbox(rung, processes=PROCESSES) if rung else None,
        )
    except RendererError as error:
        failure = str(error)
    lines = (grader.work / LOG_FILE).read_bytes()[-OUTPUT_BYTES:].decode(errors="replace").splitlines()
    return failure, lines[-1] if lines else ""


def _told_in_log(name: str, grader: Grader, failure: str) -> str:
    """Whether a link led us to tell what only we may read."""
    if name != "links":
        return ""
    log = grader.work / LOG_FILE
    if log.is_symlink() or not log.is_file() or grader.secret in log.read_text(encoding="utf-8") + failure:
        return "had its log replaced by a file of the grader's"
    left = sorted({path.name for path in grader.work.iterdir()} - {"scene.json", _COPY, LOG_FILE})
    return f"left {left[0]} behind" if left else ""
