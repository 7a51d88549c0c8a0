"""How long a class takes: synthetic submissions, in several languages, right and wrong, and five that are hostile.

    python -m benchmarks.class_speed 200 [--scheduler ADDRESS]

makes and grades so many in a temporary folder, and prints submissions a minute and what each kind takes.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.likeness import EXAMPLES, MISTAKES, SOURCES

LANGUAGES = ("python", "javascript", "cpp")
HOSTILE = {
    "crashes": "import os; os.abort()",
    "hangs": "while True: pass",
    "fork bomb": "import os\nwhile True: os.fork()",
    "fills the disk": "import sys\nwhile True: open(sys.argv[2], 'ab').write(bytes(1 << 24))",
    "writes garbage": "import sys; open(sys.argv[2], 'wb').write(b'PF garbage')",
}
# A hang takes all of the time for each of its scenes; the examples in Python need some seconds on a busy machine.
LIMITS = "[limits]\nseconds = 20\nmemory_mib = 65536\noutput_mib = 64\n"
ASSIGNMENT = "shadows"


def made_class(folder: Path, count: int) -> None:
    """Write so many submissions, the first five of which are hostile; each is named by what it is."""
    kinds = [(language, mistake) for language in LANGUAGES for mistake in MISTAKES]
    for number in range(count):
        if number < len(HOSTILE):
            kind = list(HOSTILE)[number]
            work = folder / f"{number:03} {kind}"
            shutil.copytree(EXAMPLES / "python", work)
            (work / "tracer.py").write_text(HOSTILE[kind], encoding="utf-8")
            build = ["true"]
        else:
            language, mistake = kinds[number % len(kinds)]
            work = folder / f"{number:03} {language}, {mistake}"
            file, build = SOURCES[language]
            shutil.copytree(EXAMPLES / language, work)
            text = (work / file).read_text(encoding="utf-8")
            for old, new in MISTAKES[mistake].items():
                text = text.replace(old, new)
            (work / file).write_text(text, encoding="utf-8")
        (work / "build.sh").write_text(" ".join(build), encoding="utf-8")


def written_assignment(folder: Path) -> Path:
    """A ready assignment with shorter limits, and a build command."""
    from raytruth.comparisons.grading.assignment_file import assignment_path  # noqa: PLC0415 - the run has its own process

    text = assignment_path(ASSIGNMENT).read_text(encoding="utf-8")
    start, _, rest = text.partition("[limits]\n")
    path = folder / "class.toml"
    path.write_text(f'{start}build = "sh build.sh"\n{LIMITS}\n[[models]]{rest.partition("[[models]]")[2]}')
    return path


def main() -> None:
    """Make a class, grade it, and print how long it took."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    with TemporaryDirectory(prefix="raytruth-") as name:
        folder = Path(name)
        made_class(folder / "class", count)
        command = [sys.executable, "-m", "raytruth", "grade-all", str(folder / "class"), *sys.argv[2:]]
        options = ["--assignment", str(written_assignment(folder)), "--out", str(folder / "graded")]
        start = time.perf_counter()
        subprocess.run([*command, *options], check=False)
        seconds = time.perf_counter() - start
        rows = json.loads((folder / "graded" / "class.json").read_text(encoding="utf-8"))["rows"]
    print(f"{count} submissions in {seconds:.0f} s: {60 * count / seconds:.1f} a minute")
    kinds: dict[str, list[float]] = {}
    for row in rows:
        kinds.setdefault(row["student"][4:], []).append(row["seconds"])
    for kind, own in sorted(kinds.items()):
        print(f"| {kind} | {len(own)} | {sum(own) / len(own):.1f} |")


if __name__ == "__main__":
    main()
