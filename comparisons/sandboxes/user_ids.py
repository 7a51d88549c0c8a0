"""User ids that programs of others run as where we are root: each of theirs has one of its own while it runs."""

from __future__ import annotations

import contextlib
import os
import socket
from contextlib import contextmanager
from typing import TYPE_CHECKING

from raytruth.comparisons.sandboxes.folder_entries import entries_below
from raytruth.comparisons.sandboxes.sandbox import SandboxError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# Ids that neither Debian nor systemd gives to anyone ("Users, Groups, UIDs and GIDs on systemd Systems": 60706 to 61183
# are unused), and that fit in 16 bits, as containers map no others. So many run side by side on the largest machine.
FIRST, LAST = 60706, 61183


@contextmanager
def reserved_user() -> Iterator[int]:
    """A user id that nobody else has as long as this holds. Raises SandboxError if all are taken.

    A name of a socket stands for each id. The kernel gives it to one process at a time, and takes it back at its end.
    """
    for user in range(FIRST, LAST + 1):
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as claim:
            try:
                claim.bind(f"\0raytruth-user-{user}")
            except OSError:  # another run has it
                continue
            yield user
            return
    raise SandboxError(f"all user ids from {FIRST} to {LAST} are in use by other runs")


def give(folder: Path, user: int) -> None:
    """Make a user the owner of a folder and of all in it, and let nobody else look into it.

    Nobody may be at work in it. A file with two names may be one of others that somebody put here: it is left alone.
    """
    os.chown(folder, user, user, follow_symlinks=False)
    for _, entry in entries_below(folder):
        with contextlib.suppress(OSError):  # its path is too long: it is removed with all else, by rm
            if entry.is_dir(follow_symlinks=False) or entry.stat(follow_symlinks=False).st_nlink == 1:
                os.chown(entry.path, user, user, follow_symlinks=False)
    folder.chmod(0o700)
