"""How a process confines itself before it becomes a program of others: groups, user id, files, system calls.

Run by isolation_guard.py between fork and exec, in a process without threads. None of it can be undone afterwards.
"""

from __future__ import annotations

import errno
import os
import resource
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    from landlockpy import Ruleset
    from seccompy import Filter


class Confinement(NamedTuple):
    """In words and numbers that JSON has, since another process applies it, which starts sooner without dataclasses."""

    groups: tuple[str, ...] = ()
    """Files of control groups, each joined by writing 0 to it."""
    user: int | None = None
    """The user and group to become; None where somebody else does that, or nobody is to."""
    processes: int = 0
    """How many of this user there may be, threads counted."""
    landlock: bool = False
    listable: tuple[str, ...] = ()
    readable: tuple[str, ...] = ()
    writable: tuple[str, ...] = ()
    """Files and folders, with Landlock; of what is listable only the names of what it holds can be read."""


def prepared(confinement: Confinement) -> Callable[[], None]:
    """What the new process is to call. All that may fail for want of a package fails here, before it is made."""
    lock = _prepared_lock(confinement) if confinement.landlock else None

    def confine() -> None:
        for group in confinement.groups:
            Path(group).write_text("0", encoding="ascii")
        if confinement.user is not None:
            os.setgroups([])
            os.setresgid(confinement.user, confinement.user, confinement.user)
            os.setresuid(confinement.user, confinement.user, confinement.user)
        resource.setrlimit(resource.RLIMIT_NPROC, (confinement.processes, confinement.processes))
        if lock is not None:
            lock()

    return confine


def _prepared_lock(confinement: Confinement) -> Callable[[], None]:
    rules, calls = _file_rules(confinement), _call_filter()

    def lock() -> None:
        rules.restrict()
        calls.load()

    return lock


def _file_rules(confinement: Confinement) -> Ruleset:
    """Files as they are granted, no TCP, no signals to processes outside; as far as this kernel can."""
    from landlockpy import AccessFS, Ruleset, Scope  # noqa: PLC0415 - optional

    reading = AccessFS.EXECUTE | AccessFS.READ_FILE | AccessFS.READ_DIR
    ruleset = Ruleset(scoped=Scope.SIGNAL | Scope.ABSTRACT_UNIX_SOCKET)
    for name in confinement.listable:
        _allow(ruleset, name, AccessFS.READ_DIR)
    for name in confinement.readable:
        _allow(ruleset, name, reading)
    # All but to make devices and sockets; to move files between these folders.
    writing = reading | AccessFS.WRITE_FILE | AccessFS.TRUNCATE | AccessFS.REFER
    writing |= AccessFS.REMOVE_DIR | AccessFS.REMOVE_FILE
    writing |= AccessFS.MAKE_DIR | AccessFS.MAKE_REG | AccessFS.MAKE_SYM | AccessFS.MAKE_FIFO
    for name in confinement.writable:
        _allow(ruleset, name, writing)
    return ruleset


def _allow(ruleset: Ruleset, name: str, access: int) -> None:
    """What is right for a folder is refused for a file, which can only be read, written and run."""
    from landlockpy import AccessFS  # noqa: PLC0415 - optional

    of_files = AccessFS.EXECUTE | AccessFS.READ_FILE | AccessFS.WRITE_FILE | AccessFS.TRUNCATE | AccessFS.IOCTL_DEV
    rights = AccessFS(access)
    if Path(name).exists():
        ruleset.allow_path(name, rights if Path(name).is_dir() else rights & of_files)


# What gives a program a way around Landlock, to other processes, or to seldom used parts of the kernel.
_REFUSED = (
    *("socket", "io_uring_setup"),
    *("ptrace", "process_vm_readv", "process_vm_writev", "pidfd_getfd", "kcmp"),
    *("add_key", "keyctl", "request_key", "bpf", "perf_event_open", "userfaultfd"),
    *("mount", "umount2", "pivot_root", "open_tree", "move_mount", "fsopen", "fsmount", "unshare", "setns"),
    *("msgget", "semget", "shmget", "mq_open", "open_by_handle_at"),
)
# CLONE_NEWTIME is no flag of clone. <linux/sched.h>: NEWNS, NEWCGROUP, NEWUTS, NEWIPC, NEWUSER, NEWPID, NEWNET.
_NEW_NAMESPACES = 0x00020000 | 0x02000000 | 0x04000000 | 0x08000000 | 0x10000000 | 0x20000000 | 0x40000000
# <asm/unistd.h>: on x86-64 a call with this bit is the same call by another name.
_X32 = 0x40000000


def _call_filter() -> Filter:
    """No sockets, and so no network; no namespaces; nothing that reaches into other processes."""
    from seccompy import ArgCmp, CmpOp, Filter, syscall_nr  # noqa: PLC0415 - optional

    calls = Filter()
    for name in _REFUSED:
        calls.errno(name, errno.EPERM)
        calls.errno(syscall_nr(name) | _X32, errno.EPERM)
    calls.allow("clone", args=[ArgCmp(0, CmpOp.MASKED_EQ, 0, mask=_NEW_NAMESPACES)])
    calls.errno("clone", errno.EPERM)
    calls.errno(syscall_nr("clone") | _X32, errno.EPERM)
    # Its flags are in memory, where a filter cannot look. C libraries take clone where there is no clone3.
    calls.errno("clone3", errno.ENOSYS)
    calls.errno(syscall_nr("clone3") | _X32, errno.ENOSYS)
    return calls
