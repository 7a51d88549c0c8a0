from __future__ import annotations

import io
import os
import stat
import subprocess
import tarfile
import zipfile
from typing import TYPE_CHECKING

import pytest

from raytruth.comparisons.classes.archives import ArchiveError, Room, unpack

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

pytestmark = pytest.mark.clause("CLA-1")

SMALL = Room(files=4, bytes=1 << 21, ratio=500.0)


def zipped(path: Path, members: dict[str, bytes], mode: int = 0) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            member = zipfile.ZipInfo(name)
            member.external_attr = mode << 16
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, content)
    return path


def tarred(path: Path, *members: tarfile.TarInfo, content: bytes = b"x") -> Path:
    with tarfile.open(path, "w:gz" if path.name.endswith("gz") else "w") as archive:
        for member in members:
            member.size = len(content) if member.isreg() else 0
            archive.addfile(member, io.BytesIO(content) if member.isreg() else None)
    return path


def tar_member(name: str, kind: bytes = tarfile.REGTYPE, link: str = "") -> tarfile.TarInfo:
    member = tarfile.TarInfo(name)
    member.type, member.linkname = kind, link
    return member


def refusal(path: Path, room: Room = SMALL) -> str:
    with pytest.raises(ArchiveError) as error:
        unpack(path, path.parent / "unpacked" / "deep", room)
    assert len(str(error.value).splitlines()) == 1
    return str(error.value)


def test_files_of_each_kind_of_archive_and_folder_arrive_with_their_bytes(tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    (folder / "src").mkdir(parents=True)
    (folder / "src" / "a.py").write_bytes(b"content")
    (folder / ".git").mkdir()
    (folder / ".git" / "HEAD").write_bytes(b"history")
    repository = ["git", "-c", "user.name=a", "-c", "user.email=a@b"]
    clone = tmp_path / "clone"
    for words in (
        ["git", "init", "-q", str(clone)],
        ["cp", "-r", str(folder / "src"), str(clone)],
        [*repository, "-C", str(clone), "add", "."],
        [*repository, "-C", str(clone), "commit", "-qm", "-"],
        ["git", "-C", str(clone), "bundle", "create", "-q", str(tmp_path / "a.bundle"), "HEAD"],
    ):
        subprocess.run(words, check=True, capture_output=True)
    sources = [
        folder,
        tmp_path / "a.bundle",
        zipped(tmp_path / "a.zip", {"src/a.py": b"content", "__MACOSX/src/._a.py": b"-"}),
        tarred(tmp_path / "a.tar.gz", tar_member("src/a.py"), content=b"content"),
        tarred(tmp_path / "a.tar", tar_member("./src/a.py"), content=b"content"),
    ]
    for number, source in enumerate(sources):
        target = tmp_path / f"unpacked-{number}"
        unpack(source, target)
        assert [path.read_bytes() for path in target.rglob("*") if path.is_file()] == [b"content"]
        assert (target / "src" / "a.py").is_file()


def test_what_may_be_executed_still_may(tmp_path: Path) -> None:
    unpack(zipped(tmp_path / "a.zip", {"run.sh": b"-"}, stat.S_IFREG | 0o755), tmp_path / "out")
    assert os.access(tmp_path / "out" / "run.sh", os.X_OK)


@pytest.mark.parametrize("name", ["../evil", "/evil", "a/../../evil", "..\\evil", "C:/evil"])
def test_a_path_that_leads_outside_is_refused_and_nothing_is_written_there(name: str, tmp_path: Path) -> None:
    assert "a path that leads out of it" in refusal(zipped(tmp_path / "a.zip", {name: b"-"}))
    assert "a path that leads out of it" in refusal(tarred(tmp_path / "a.tar", tar_member(name)))
    assert not list(tmp_path.rglob("evil"))


@pytest.mark.parametrize("kind", [tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.CHRTYPE, tarfile.FIFOTYPE])
def test_links_and_devices_in_a_tar_file_are_refused(kind: bytes, tmp_path: Path) -> None:
    assert "a link or a device" in refusal(tarred(tmp_path / "a.tar", tar_member("a", kind, "/etc/passwd")))


def a_fifo(path: Path) -> None:
    os.mkfifo(path)


def a_link(path: Path) -> None:
    path.symlink_to("/")


@pytest.mark.parametrize("make", [a_fifo, a_link])
def test_links_and_devices_in_folders_and_zip_files_are_refused(make: Callable[[Path], None], tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    make(folder / "a")
    assert "a link or a device" in refusal(folder)
    assert "; hand in" in refusal(folder / "a")
    assert "a link or a device" in refusal(zipped(tmp_path / "a.zip", {"a": b"/etc"}, stat.S_IFLNK | 0o777))


def test_bombs_are_refused_by_bytes_by_ratio_and_by_files(tmp_path: Path) -> None:
    zeros = bytes(3 << 20)
    assert "bytes, unpacked" in refusal(zipped(tmp_path / "a.zip", {"z": zeros}))
    assert "bytes, unpacked" in refusal(tarred(tmp_path / "a.tar.gz", tar_member("a"), content=zeros))
    by_ratio = Room(files=4, bytes=1 << 30, ratio=100.0)
    assert "bytes, unpacked" in refusal(zipped(tmp_path / "b.zip", {"b": zeros}), by_ratio)
    assert "more than 4 files" in refusal(zipped(tmp_path / "c.zip", {f"{number}": b"" for number in range(5)}))
    held = sum(path.stat().st_size for path in (tmp_path / "unpacked").rglob("*") if path.is_file())
    assert held <= 3 * SMALL.bytes  # what was written before a limit was hit


def test_a_tar_header_that_announces_gigabytes_of_names_is_not_read_into_memory(tmp_path: Path) -> None:
    member = tarfile.TarInfo("a")
    member.type, member.size = tarfile.XHDTYPE, (8 << 30) - 1
    with (tmp_path / "a.tar").open("wb") as file:
        file.write(member.tobuf(tarfile.USTAR_FORMAT))
        file.truncate(8 << 30)  # takes no room on the disk
    assert "unpacked" in refusal(tmp_path / "a.tar", Room(files=4, bytes=1 << 16, ratio=1.0))


@pytest.mark.parametrize("name", ["a.zip", "a.tar", "a.tar.gz", "a.bundle", "a.tar.xz"])
@pytest.mark.parametrize("content", [b"", b"PK\3\4garbage", b"\x1f\x8bgarbage", bytes(range(256)) * 8])
def test_garbage_is_one_sentence_that_names_the_file(name: str, content: bytes, tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(content)
    assert name in refusal(tmp_path / name)


def test_two_members_of_one_name_and_a_name_that_is_too_long_are_refused(tmp_path: Path) -> None:
    assert "cannot be unpacked" in refusal(tarred(tmp_path / "a.tar", tar_member("a"), tar_member("a")))
    assert "cannot be unpacked" in refusal(zipped(tmp_path / "a.zip", {"n" * 60_000: b""}))


def test_of_an_export_what_is_refused_is_left_out_and_told_and_the_rest_arrives(tmp_path: Path) -> None:
    told: list[str] = []
    source = tarred(tmp_path / "a.tar", tar_member("link", tarfile.SYMTYPE, "/"), tar_member("../b"), tar_member("c"))
    unpack(source, tmp_path / "out", SMALL, told)
    assert len(told) == 2
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["c"]
