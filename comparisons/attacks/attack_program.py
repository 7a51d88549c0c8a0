"""The program that attacks from inside a sandbox: one attack a run, and its last line says what came of it.

Run as `python -I -S attack_program.py ATTACK VALUES`, where VALUES are JSON. It uses the standard library only. It
prints `held`, or `not held: ` and a clause; or it is ended by the limit that it attacks. Each attack is bounded, so
that it does no harm where nothing holds it.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import mmap
import os
import resource
import select
import signal
import socket
import sys
import time
from pathlib import Path
from typing import Any

MEBIBYTE = 1 << 20
# As long as a limit that is looked after now and then is given: some of its looks, also on a busy machine.
PATIENCE_SECONDS = 3.0
POLL_SECONDS = 0.02


def fork_bomb(values: dict[str, Any]) -> str:
    """As many children as are allowed, and some more."""
    children = []
    try:
        for _ in range(2 * values["processes"]):
            child = os.fork()
            if child == 0:
                time.sleep(10 * PATIENCE_SECONDS)
                os._exit(0)
            children.append(child)
    except OSError:
        return ""
    finally:
        for child in children:
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
    return f"started {len(children)} processes"


def memory_of_one(values: dict[str, Any]) -> str:
    """One piece of twice the memory, which is not touched."""
    try:
        with mmap.mmap(-1, 2 * values["memory"]):
            return f"had {2 * values['memory'] // MEBIBYTE} MiB"
    except (OSError, MemoryError):
        return ""


def memory_of_all(values: dict[str, Any]) -> str:
    """Three children with half of the memory each, which is touched."""
    filled, fill = os.pipe()
    children = []
    for _ in range(3):
        child = os.fork()
        if child == 0:
            memory = mmap.mmap(-1, values["memory"] // 2)
            for place in range(0, len(memory), mmap.PAGESIZE):
                memory[place] = 1
            os.write(fill, b"x")
            time.sleep(10 * PATIENCE_SECONDS)
            os._exit(0)
        children.append(child)
    os.close(fill)
    full = 0
    # One that is ended leaves fewer than all full, and then none that could write to the pipe.
    while full < len(children) and not _one_has_ended(children):
        if select.select([filled], [], [], POLL_SECONDS)[0]:
            full += len(os.read(filled, len(children)))
    deadline = time.monotonic() + PATIENCE_SECONDS
    while not (ended := _one_has_ended(children)) and time.monotonic() < deadline:
        time.sleep(POLL_SECONDS)
    for child in children:
        os.kill(child, signal.SIGKILL)
    return "" if ended else f"had {3 * values['memory'] // 2 // MEBIBYTE} MiB in three processes"


def _one_has_ended(children: list[int]) -> bool:
    """Whether one of them is gone; it is not taken leave of, so that its number stays its own."""
    states = [os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) for child in children]
    return any(state is not None for state in states)


def one_file(values: dict[str, Any]) -> str:
    """A file of twice the size."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        with Path("large").open("wb") as file:
            for _ in range(2 * values["file"] // MEBIBYTE):
                file.write(bytes(MEBIBYTE))
    except OSError:
        return ""
    return f"wrote a file of {2 * values['file'] // MEBIBYTE} MiB"


def many_files(values: dict[str, Any]) -> str:
    """Files of the size that is allowed, four times as many as may be."""
    for number in range(8):
        Path(f"part-{number}").write_bytes(bytes(values["file"]))
    time.sleep(PATIENCE_SECONDS)
    return f"wrote {8 * values['file'] // MEBIBYTE} MiB in files"


def shared_folders(values: dict[str, Any]) -> str:
    """A file in each folder that is everybody's, unless that is the program's own, which is counted."""
    own = os.environ["TMPDIR"]
    reached = []
    for folder in ("/tmp", "/var/tmp", "/dev/shm", "/run/lock"):
        try:
            if not Path(folder).samefile(own):
                mine = Path(folder) / values["token"]
                mine.write_bytes(b"x")
                mine.unlink()
                reached.append(folder)
        except OSError:
            continue
    return f"wrote to {', '.join(reached)}" if reached else ""


def processor(_: dict[str, Any]) -> str:
    """Two processes that never rest."""
    os.fork()
    while True:
        pass


def output(_: dict[str, Any]) -> str:
    """Words without end."""
    while True:
        print("garbage" * 10_000, flush=True)


def escape(_: dict[str, Any]) -> str:
    """A daemon in a group and a session of its own, of which the grader would see no parent."""
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            signal.signal(signal.SIGTERM, signal.SIG_IGN)
            signal.signal(signal.SIGHUP, signal.SIG_IGN)
            time.sleep(60 * PATIENCE_SECONDS)
        os._exit(0)
    return ""


def network(values: dict[str, Any]) -> str:
    """To a server on this machine by TCP, UDP and a local socket, and to be a server."""
    address = ("127.0.0.1", values["port"])
    reached = []
    for name, kind, target in (
        ("TCP", (socket.AF_INET, socket.SOCK_STREAM), address),
        ("a local socket", (socket.AF_UNIX, socket.SOCK_STREAM), f"\0{values['token']}"),
    ):
        try:
            with socket.socket(*kind) as link:
                link.settimeout(PATIENCE_SECONDS)
                link.connect(target)
            reached.append(name)
        except OSError:
            continue
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
            link.sendto(values["token"].encode(), address)  # whether it arrives, the grader sees
    except OSError:
        pass
    return f"reached the grader's machine by {' and '.join(reached)}" if reached else ""


def reading(values: dict[str, Any]) -> str:
    """A file of the grader's, by its name and by way of the grader's process."""
    for path in (values["path"], f"/proc/{values['pid']}/root{values['path']}"):
        try:
            if values["secret"] in Path(path).read_text(encoding="utf-8", errors="replace"):
                return "read it, as all users may" if Path(path).stat().st_mode & 0o004 else "read it"
        except OSError:
            continue
    return ""


def looking_into_the_grader(values: dict[str, Any]) -> str:
    """Another process's environment, and its memory through a debugger's call."""
    try:
        if values["token"].encode() in Path(f"/proc/{values['pid']}/environ").read_bytes():
            return "read the environment of a process of the grader's"
    except OSError:
        pass
    buffer = ctypes.create_string_buffer(8)
    # struct iovec: where, and how many bytes.
    local = (ctypes.c_void_p * 2)(ctypes.addressof(buffer), 8)
    remote = (ctypes.c_void_p * 2)(values["address"], 8)
    copied = ctypes.CDLL(None).process_vm_readv(values["pid"], ctypes.byref(local), 1, ctypes.byref(remote), 1, 0)
    return "read the memory of a process of the grader's" if copied > 0 else ""


def rewriting(values: dict[str, Any]) -> str:
    """A grade that is there already: write to it, remove it, put another in its place."""
    grade = Path(values["path"])
    for path in (grade, grade.with_suffix(".new")):
        try:
            path.write_text("100 of 100", encoding="utf-8")
            return "wrote to the folder of results"
        except OSError:
            continue
    return ""


def signals(values: dict[str, Any]) -> str:
    """End a process of the grader's; whether it ended, the grader sees."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.kill(values["pid"], number)
        except OSError:
            continue
    return ""


def links(values: dict[str, Any]) -> str:
    """Links to a file of the grader's in place of all that it will read, a pipe, and folders that are too deep."""
    for name in ("log.txt", "output.pfm", "picture"):
        Path(name).symlink_to(values["path"])
    os.mkfifo("pipe")
    Path("deep").mkdir()
    Path("deep").chmod(0)
    sys.exit("its picture is a link")


def becoming_root(_: dict[str, Any]) -> str:
    """To be user 0, to become it, and to read what only user 0 may, whatever it is called here."""
    for become in (os.setuid, os.seteuid):
        with contextlib.suppress(OSError):
            become(0)
    if 0 in os.getresuid():
        return "runs as root"
    try:
        Path("/etc/shadow").read_bytes()
    except OSError:
        return ""
    return "reads what only root may"


def behaving(values: dict[str, Any]) -> str:
    """No attack: reads its scene, starts another program, and writes its picture."""
    scene = Path(values["scene"]).read_text(encoding="utf-8")
    if os.spawnlp(os.P_WAIT, "true", "true") != 0:
        return "cannot start another program"
    with Path(os.environ["TMPDIR"], "temporary").open("w", encoding="utf-8") as file:
        file.write(scene)
    Path("output.pfm").write_text(scene, encoding="utf-8")
    return "" if resource.getrlimit(resource.RLIMIT_AS)[0] == values["memory"] else "has no limit of memory"


def main() -> None:
    """Run the attack that is named, and tell."""
    told = globals()[sys.argv[1]](json.loads(sys.argv[2]))
    print(f"not held: {told}" if told else "held", flush=True)


if __name__ == "__main__":
    main()
