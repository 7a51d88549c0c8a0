"""The command line: which commands there are, and how each way of going wrong ends.

Commands are named by their modules and imported only when they run, so that `--help` answers at once.
"""

from __future__ import annotations

import os
import sys
from importlib.metadata import version
from typing import TYPE_CHECKING

from cyclopts import App, CycloptsError

from raytruth.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence

BAD_USAGE = 2
UNFORESEEN = 3
INTERRUPTED = 130  # what shells give for a program that SIGINT (2) ended: 128 + 2
BROKEN_PIPE = 141  # likewise for SIGPIPE (13)

HELP = """raytruth tells whether a ray tracer is right: how far from the truth, and which term it got wrong.

Try `raytruth scenes list`, then `raytruth explain whitted-1980 --pixel 80,60`.
"""

COMMANDS = {
    "run": (
        "raytruth.run_command:run",
        "Run the conformance matrix: scenes × renderers, each cell judged against the truth.",
        "Exit status 0 if no comparable cell fails, 1 if one fails unwaived or errs, a waiver matches nothing, or a "
        "required renderer is missing; with --strict also if one is as declared, not as due. "
        "Examples: `raytruth run`, `raytruth run whitted-1980 mine.json --renderer mitsuba --out results`",
    ),
    "judge": (
        "raytruth.judge_command:judge",
        "Judge finished pictures of a scene, whoever rendered them.",
        "Exit status as that of `raytruth run`. Examples: `raytruth judge mine.exr --scene whitted-1980`, "
        "`raytruth judge mine.png --scene mine.json --renderer-file mine.toml --out results`",
    ),
    "compare": (
        "raytruth.compare_command:compare",
        "Show two images side by side, pixel by pixel, with the truth beside them where a scene is named.",
        "Examples: `raytruth compare before.exr after.exr`, `raytruth compare a.exr b.exr --scene whitted-1980`",
    ),
    "grade": (
        "raytruth.grade_command:grade",
        "Grade one program by an assignment: points, and a proof of what explains the pixels that are wrong.",
        "Exit status 0 with full marks, 1 without, 3 where raytruth itself failed, which is no grade. "
        "Examples: `raytruth grade -- ./tracer {scene} {output}.pfm`, "
        "`raytruth grade --assignment shadows --renderer-file tracer.toml --out grade`",
    ),
    "sandboxes": (
        "raytruth.sandboxes_command:sandboxes",
        "Try attacks on each sandbox that submissions can run in here, and tell what held.",
        "Takes some seconds. Exit status 1 if none can be used. Example: `raytruth sandboxes --json`",
    ),
    "grade-all": (
        "raytruth.grade_all_command:grade_all",
        "Grade a class: a table, a page for each student and one for the class, and what Moodle and Canvas take.",
        "Exit status 0 if all are graded, 1 if some could not be run, 3 where raytruth itself failed on some. "
        "Examples: `raytruth grade-all submissions --assignment mine.toml --build make`, "
        "`raytruth grade-all moodle-export.zip --run './tracer {scene} {output}.pfm' --out graded`",
    ),
    "trace": (
        "raytruth.trace_command:trace",
        "Compare the ray tree that a program prints of a pixel with the right one, ray by ray.",
        "Exit status 0 if all rays agree, 1 if one differs or the program fails. "
        "Example: `raytruth trace glass-sphere --quick --pixel 10,7 -- ./tracer {scene} {output}.pfm`",
    ),
    "oracle": (
        "raytruth.oracle_command:oracle",
        "Answer single steps of a ray tracer, proven, for unit tests in any language: lines of JSON in and out.",
        "Exit status 0 if all was answered, 2 if a line was no good question: its answer then has a key `error`. "
        "`ask` is intersect_sphere, intersect_triangle, intersect_plane, intersect_box, reflect, refract, fresnel, "
        "shade or primary_ray. Example: "
        """`echo '{"ask": "fresnel", "cosine": 0.5, "index_from": 1, "index_to": 1.5}' | raytruth oracle`""",
    ),
    "scenes": ("raytruth.scenes_commands:app", "List, show, validate and export scenes.", ""),
    "renderers": (
        "raytruth.renderers_command:renderers",
        "Show who can render here, what each can do, and how to install the rest.",
        "Each renderer is tried, which takes some seconds. Example: `raytruth renderers mitsuba --json`",
    ),
    "render": (
        "raytruth.render_command:render",
        "Render a scene with the reference tracer.",
        "Examples: `raytruth render whitted-1980 -o whitted.png --size 640x480 --samples 4`, "
        "`raytruth render mine.json -o mine.exr --arithmetic float32`",
    ),
    "truth": (
        "raytruth.truth_command:truth",
        "Prove the value of each pixel: the tracer in ball arithmetic, with as many bits as each pixel needs.",
        "Writes an OpenEXR image of values and radii, and a JSON file of undecided pixels. "
        "Examples: `raytruth truth whitted-1980`, `raytruth truth mine.json --size 320x240 --json`",
    ),
    "explain": (
        "raytruth.explain_command:explain",
        "Explain one pixel: every ray of its tree, every hit, normal, term and weight, and the sum.",
        "Examples: `raytruth explain whitted-1980 --pixel 80,60`, `raytruth explain mine.json --pixel 0,0 --json`, "
        "`raytruth explain mine.json --pixel 0,0 --proof proof.json`, `raytruth explain mine.json --check proof.json`. "
        "Exit status 1 for a proof that does not hold.",
    ),
    "faults": (
        "raytruth.faults_command:faults",
        "Run the kill matrix: every known fault must be found on some scene, and no legitimate variant on any.",
        "Exit status 0 if all faults are killed and no variant is flagged, else 1. What has not changed is taken over. "
        "Examples: `raytruth faults`, `raytruth faults --json --out results`, "
        "`raytruth faults --scene mine.json --leaderboard board.json --by Ada`",
    ),
    "court": (
        "raytruth.court_command:court",
        "Put rays whose hit is disputed in public to several programs and forms, and tell who is right.",
        "Examples: `raytruth court`, `raytruth court edge-of-two-triangles --json`, `raytruth court --csv court.csv`",
    ),
    "spec": (
        "raytruth.spec_command:spec",
        "Show which tests, scenes and faults hold each clause of the specification, and what is missing.",
        "Exit status 1 if anything is missing. Needs a clone of the repository. Example: `raytruth spec --json`",
    ),
    "report": (
        "raytruth.report_command:report",
        "Rebuild the report of a results directory from its files alone.",
        "Examples: `raytruth report results`, `raytruth report results --against earlier`, "
        "`raytruth report results --junit junit.xml`",
    ),
}
"""Each command's function, its summary, and what its own `--help` adds."""


def make_app() -> App:
    """The command line's parser, with all commands."""
    app = App(
        name="raytruth",
        help=HELP,
        version=lambda: version("raytruth"),
        help_format="markdown",
        suppress_keyboard_interrupt=False,  # `main` says that it was interrupted
    )
    for name, (place, summary, more) in COMMANDS.items():
        app.command(place, name=name, help=f"{summary}\n\n{more}")
    return app


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; returns the exit status.

    0, what the command says, 2 for bad usage or input, or 3 where raytruth itself is at fault.
    """
    _let_all_text_be_printed()
    tokens = list(sys.argv[1:] if arguments is None else arguments)
    try:
        return _status_of(tokens)
    except Exception as error:
        from raytruth.unforeseen import sentence_and_log  # noqa: PLC0415 - so that `--help` is quick

        _tell(sentence_and_log(error, tokens))
        return UNFORESEEN


def _status_of(tokens: list[str]) -> int:
    """The exit status of a command, each foreseen way of going wrong told in one sentence."""
    try:
        result = make_app()(tokens, exit_on_error=False, print_error=False, result_action="return_value")
        print(end="", flush=True)  # so that a broken pipe is noticed here
    except BrokenPipeError:
        _discard_output()
        return BROKEN_PIPE
    except KeyboardInterrupt:
        print("raytruth: interrupted.", file=sys.stderr)
        return INTERRUPTED
    except CycloptsError as error:
        return _bad_usage(f"{_one_line(error)} See raytruth --help.")
    except UsageError as error:
        return _bad_usage(str(error))
    except OSError as error:
        return _bad_usage(_told(error))
    return result if isinstance(result, int) else 0


def _let_all_text_be_printed() -> None:
    """A terminal that cannot show η shows a question mark, and the program goes on."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="replace")


def _discard_output() -> None:
    """What is still buffered must not fail once more when Python ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _told(error: OSError) -> str:
    """The error in one sentence; one without a file's name comes from standard output."""
    if error.filename is not None:
        return f"{error.filename}: {error.strerror}."
    _discard_output()
    return f"the output cannot be written: {error.strerror or error}."


def _bad_usage(sentence: str) -> int:
    _tell(sentence)
    return BAD_USAGE


def _tell(sentence: str) -> None:
    """Names of files may hold control characters, which are shown as marks."""
    from raytruth.reports.wording import printable  # noqa: PLC0415 - so that `--help` is quick

    print(printable(f"raytruth: {sentence}"), file=sys.stderr)


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())
