"""Which sandbox a program of others runs in, and why a rung of the ladder cannot be used here."""

from __future__ import annotations

import importlib.util
import os
import shutil
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

Rung = Literal["bubblewrap", "landlock", "user"]
RUNGS: tuple[Rung, ...] = ("bubblewrap", "landlock", "user")
"""From the one that holds most to the one that holds least."""

MOST_PROCESSES = 512
"""Of a program and all that it starts, at once, threads counted: one for each processor of a large machine, with shells
around them."""

# What a program needs to find others, to write text and to tell the time; whatever else the grader's environment holds,
# such as the token of a service, is not for submissions.
_KEPT_VARIABLES = ("PATH", "LANG", "LANGUAGE", "LC_ALL", "LC_CTYPE", "LC_NUMERIC", "TZ", "JAVA_HOME")


class SandboxError(Exception):
    """The sandbox could not be set up: this is the grader's trouble, and never the submission's."""


@dataclass(frozen=True)
class Sandbox:
    """A rung of the ladder, and what a program may see in it besides the system's own files and its own folder."""

    rung: Rung
    visible: tuple[tuple[Path, Path], ...] = ()
    """Files and folders, absolute, that it may read and run but not write: what each is called, and what is there,
    which is the same or a copy."""
    listable: tuple[Path, ...] = ()
    """Folders of which it may see parts only, and the names of the rest where the rung cannot conceal them."""
    hidden: tuple[Path, ...] = ()
    """What it must not see, even if it lies among the system's files."""
    processes: int = MOST_PROCESSES
    """How many it may have at once."""


def is_root() -> bool:
    """Whether we are user 0, as which no program of others may run."""
    return os.geteuid() == 0


def missing_for(rung: Rung) -> str | None:
    """Why a rung cannot even be tried here, in one clause; None if it can."""
    if rung == "bubblewrap" and shutil.which("bwrap") is None:
        return "the program bwrap is not installed (apt-get install bubblewrap)"
    if rung == "bubblewrap" and is_root() and shutil.which("setpriv") is None:
        return "the program setpriv, which drops the user id, is not installed (apt-get install util-linux)"
    if rung == "landlock":
        absent = [name for name in ("landlockpy", "seccompy") if importlib.util.find_spec(name) is None]
        if absent:
            return f"the Python package {absent[0]} is not installed (pip install 'raytruth[sandbox]')"
        return _missing_in_kernel()
    if rung == "user" and not is_root():
        return "only root can run a program as another user"
    return None


def kept_environment(environment: Mapping[str, str], home: Path) -> dict[str, str]:
    """What of our environment a program in a sandbox has; its home is a folder of its own."""
    kept = {name: environment[name] for name in _KEPT_VARIABLES if name in environment}
    return {**kept, "HOME": str(home)}


def _missing_in_kernel() -> str | None:
    import landlockpy  # noqa: PLC0415 - optional
    import seccompy  # noqa: PLC0415 - optional

    if not landlockpy.supported():
        return "this system's kernel has no Landlock, or it is switched off"
    if not seccompy.supported():
        return "this system's kernel does not let programs filter system calls"
    return None
