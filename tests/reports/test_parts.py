from __future__ import annotations

import base64
from typing import TYPE_CHECKING

import pytest

from raytruth.reports.parts import Parts

if TYPE_CHECKING:
    from pathlib import Path

pytestmark = pytest.mark.clause("REP-10")


def test_the_same_content_is_stored_once_and_another_beside_it(tmp_path: Path) -> None:
    parts = Parts(tmp_path)
    names = [parts.add_picture(png) for png in (b"one", b"two", b"one")]
    assert names[0] == names[2] != names[1]
    assert [(tmp_path / name).read_bytes() for name in names] == [b"one", b"two", b"one"]
    assert len(list((tmp_path / "pictures").iterdir())) == 2


def test_arrays_of_a_folder_are_scripts_and_those_of_a_page_are_data(tmp_path: Path) -> None:
    in_folder, in_page = Parts(tmp_path), Parts()
    name = in_folder.add_arrays("{}")
    assert in_page.add_arrays("{}") == name
    assert (tmp_path / name).read_text(encoding="ascii") == f'raytruthArrays("{name}", {{}});\n'
    assert in_page.kept[name] == b"{}"


def test_a_kept_picture_is_an_address_that_holds_it() -> None:
    parts = Parts()
    head, _, content = parts.data_uri(parts.add_picture(b"png")).partition(",")
    assert head == "data:image/png;base64"
    assert base64.b64decode(content) == b"png"
