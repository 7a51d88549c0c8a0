"""The first rung: bubblewrap gives a program namespaces of its own, in which nothing else exists.

bwrap(1) describes the options. An ordinary user needs user namespaces for it. Root does not, and must not use them:
user 0 outside would own what runs inside. So there the user id is dropped in between, by setpriv(1).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.sandboxes.visible_paths import PROCESSORS

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

_NAMESPACES = ("--unshare-ipc", "--unshare-pid", "--unshare-net", "--unshare-uts", "--unshare-cgroup-try")
_TO_DROP_THE_ID = ("--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID")
# The folder is its user's alone, so that nobody can enter it before the id is dropped.
_IN_FOLDER = ("sh", "-c", 'cd "$0" && exec "$@"')
# Folders for temporary files and shared memory that everybody may write to. Here they are the program's own, where what
# it writes is counted; in a file system in memory it would not be.
_SHARED = ("/tmp", "/var/tmp", "/dev/shm")


def wrapped(
    command: Sequence[str],
    folder: Path,
    scratch: Path,
    system: Sequence[Path],
    visible: Sequence[tuple[Path, Path]],
    user: int | None,
) -> list[str]:
    """The command in a sandbox in which it can write to `folder` and `scratch` only, as this user if we are root.

    `system` is what it may see of the system's files, and `visible` are names of others with what is shown there.
    """
    words = ["bwrap", *_NAMESPACES, "--die-with-parent", "--new-session", "--cap-drop", "ALL"]
    words += ["--unshare-user"] if user is None else _TO_DROP_THE_ID
    for path in system:
        words += _shown_system(path)
    words += ["--proc", "/proc", "--dev", "/dev"]
    words += ["--ro-bind-try", str(PROCESSORS), str(PROCESSORS)]
    # What is made by --dir all may enter. Folders that bwrap makes around another may be private to root.
    words += ["--dir", "/var"]
    for place in _SHARED:
        words += ["--bind", str(scratch), place]
    words += ["--dir", str(folder.resolve().parent)]
    for path, shown in visible:
        for name in dict.fromkeys((path, path.resolve())):
            words += ["--dir", str(name.parent), "--ro-bind", str(shown.resolve()), str(name)]
    place = str(folder.resolve())
    words += ["--bind", place, place, "--remount-ro", "/dev", "--remount-ro", "/"]
    if user is None:
        return [*words, "--chdir", place, "--", *command]
    return [*words, "--chdir", "/", "--", *_as_user(user), *_IN_FOLDER, place, *command]


def _shown_system(path: Path) -> list[str]:
    """As a link where it is one, as /bin to usr/bin."""
    if path.is_symlink():
        return ["--symlink", str(path.readlink()), str(path)]
    return ["--dir", str(path.parent), "--ro-bind", str(path), str(path)]


def _as_user(user: int) -> list[str]:
    ids = ["--reuid", str(user), "--regid", str(user), "--clear-groups"]
    return ["setpriv", *ids, "--no-new-privs", "--inh-caps=-all", "--bounding-set=-all", "--"]
