"""What a program may see in a sandbox: the system's files, what is installed on the PATH, and its own files."""

from __future__ import annotations

import os
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

SYSTEM = tuple(
    Path(name) for name in ("/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/etc", "/nix/store")
)
"""Programs, libraries and their settings. Where people keep what is their own (/home, /srv, /opt, …) is not here."""

PROCESSORS = Path("/sys/devices/system/cpu")
"""How many processors there are, which runtimes ask."""

# Where a person's own programs are installed beside other things of theirs, of which only these are shown.
_PARTS_OF_AN_INSTALLATION = ("bin", "lib", "lib64")


@cache
def installed(search_path: str) -> tuple[Path, ...]:
    """The folders of installed programs outside the system's: of all on a PATH, of what links there lead to, and of
    the Python that runs us.
    """
    folders = [Path(name) for name in search_path.split(os.pathsep) if name]
    found = [Path(sys.prefix), Path(sys.base_prefix)]
    for folder in folders:
        if folder.is_absolute() and _can_be_listed(folder) and not _is_of_the_system(folder):
            targets = [link.resolve() for link in folder.iterdir() if link.is_symlink() and os.access(link, os.X_OK)]
            for place in (folder, *(target.parent for target in targets)):
                found += _installation(place)
    return tuple(dict.fromkeys(path for path in found if not _is_of_the_system(path)))


def installation_of(program: Path, search_path: str) -> tuple[Path, ...]:
    """The folders of a program of the PATH that is a link to somewhere else, as /usr/bin/java may be one to /opt."""
    target = program.resolve()
    if str(program.parent) not in search_path.split(os.pathsep) or _is_of_the_system(target):
        return ()
    return tuple(_installation(target.parent))


def own_files(named: Iterable[Path]) -> tuple[Path, ...]:
    """The folders of the files that a command names, with all below; of one in a home folder or above it the file."""
    found = []
    for path in named:
        folder = path.parent
        if not _is_of_the_system(path):
            found.append(path if Path.home().is_relative_to(folder.resolve()) else folder)
    return tuple(dict.fromkeys(found))


def without_hidden(visible: Iterable[Path], hidden: Iterable[Path]) -> tuple[Path, ...]:
    """The visible paths with what is hidden taken out: of a folder that holds such a path, its other entries.

    A path is hidden with all below it. What is visible inside a hidden folder stays visible: a submission may lie in
    the home folder.
    """
    concealed = [path.resolve() for path in hidden]
    return tuple(dict.fromkeys(part for path in visible for part in _parts(path, concealed)))


def _parts(path: Path, concealed: list[Path]) -> list[Path]:
    real = path.resolve()
    if real in concealed:
        return []
    if not any(secret.is_relative_to(real) for secret in concealed):
        return [path]
    entries = sorted(path.iterdir()) if _can_be_listed(path) else []
    return [part for entry in entries if os.access(entry, os.R_OK) for part in _parts(entry, concealed)]


def _installation(folder: Path) -> list[Path]:
    """What belongs to the programs in a folder called bin: the folder around it, but not a home folder with all in it.

    Of one that lies in the home folder, as ~/.cargo, only folders: files beside them are settings and passwords. An
    environment of Python's has a file of its own there.
    """
    around, home = folder.parent, Path.home()
    if folder.name != "bin":
        return [folder]
    if home.is_relative_to(around) or around == home / ".local":
        return [around / part for part in _PARTS_OF_AN_INSTALLATION if _can_be_listed(around / part)]
    if around.parent == home and not (around / "pyvenv.cfg").exists():
        return [path for path in sorted(around.iterdir()) if _can_be_listed(path)]
    return [around]


def _can_be_listed(path: Path) -> bool:
    """Whether it is a folder into which we may look; in a closed folder there is none."""
    return os.access(path, os.R_OK | os.X_OK) and path.is_dir()


def _is_of_the_system(path: Path) -> bool:
    real = path.resolve()
    return any(real.is_relative_to(folder) for folder in SYSTEM)
