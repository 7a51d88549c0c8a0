"""The page's own scripts, styles and colour tables: in files of a folder, or as texts for one single page."""

from __future__ import annotations

import base64
import hashlib
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

from raytruth.reports import pictures
from raytruth.reports.script_data import script_json

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable
    from pathlib import Path

VIEWER = files("raytruth.reports") / "viewer"
TEMPLATES = files("raytruth.reports") / "templates"
COLOUR_MAPS = ("batlow", "vik")
"""Sequential and diverging, both perceptually uniform and safe for the colour-blind (Crameri, Shephard, Heron 2020)."""

SHARED_SCRIPTS = ("messages.js", "zh-cn.js", "commands.js")
SCENE_SCRIPTS = (*SHARED_SCRIPTS, "page.js")
OVERVIEW_SCRIPTS = (*SHARED_SCRIPTS, "overview.js", "page.js")
CELL_SCRIPTS = (
    *SHARED_SCRIPTS,
    "colour-tables.js",
    "arrays.js",
    "numbers.js",
    "scales.js",
    "layers.js",
    "paint.js",
    "webgl.js",
    "stage.js",
    "overlay.js",
    "pointer.js",
    "regions.js",
    "statistics.js",
    "pixel.js",
    "tree.js",
    "controls.js",
    "legend.js",
    "address.js",
    "cell.js",
    "page.js",
)
"""In the order in which they must run."""

STYLE = "report.css"
VIEWER_STYLE = "viewer.css"


def script_text(name: str) -> str:
    """One script; two of them are made from data."""
    if name == "colour-tables.js":
        return f"const COLOUR_TABLES = {script_json({name: colour_table(name) for name in COLOUR_MAPS})};\n"
    if name == "zh-cn.js":
        return f'addMessages("zh-CN", {_text(VIEWER / "zh-cn.json").strip()});\ntranslatePage();\n'
    return _text(VIEWER / name)


def colour_table(name: str) -> str:
    """256 colours as hexadecimal digits, six each."""
    table = np.loadtxt((VIEWER / "vendored" / f"{name}.txt").read_text(encoding="utf-8").splitlines())
    return np.round(255 * table).astype(np.uint8).tobytes().hex()


def starter(names: tuple[str, ...], folder: str) -> str:
    """The only script in a page of a folder: it loads the others, in this order.

    So the page's policy can name it by its digest, and lets nothing else in the page load or run a script.
    """
    listed = script_json([f"{folder}{name}" for name in names])
    return (
        f"for (const address of {listed}) {{ const script = document.createElement('script'); "
        "script.async = false; script.src = address; document.head.append(script); }"
    )


def digest(script: str) -> str:
    """What a Content Security Policy calls a script by."""
    return base64.b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")


def style_text(*, single: bool) -> str:
    """All styles as one text; pictures of legends are in it where the page is single, else in files beside it."""
    texts = [_text(TEMPLATES / STYLE), _text(VIEWER / VIEWER_STYLE)]
    uses = {".bar.difference": "difference", ".bar.sequential": "sequential", ".swatch.unjudged": "hatch"}
    for selector, name in uses.items():
        address = f"{name}.png"
        if single:
            address = "data:image/png;base64," + base64.b64encode(_legends()[name]).decode("ascii")
        texts.append(f'{selector} {{ background-image: url("{address}"); }}')
    return "\n".join(texts)


def write_assets(folder: Path) -> None:
    """Write scripts, style and pictures of legends into a folder, which is made. Raises OSError."""
    folder.mkdir(parents=True)
    for name in dict.fromkeys((*OVERVIEW_SCRIPTS, *CELL_SCRIPTS)):
        (folder / name).write_text(script_text(name), encoding="utf-8")
    (folder / STYLE).write_text(style_text(single=False), encoding="utf-8")
    for name, png in _legends().items():
        (folder / f"{name}.png").write_bytes(png)


def _legends() -> dict[str, bytes]:
    return {
        "difference": pictures.difference_legend(),
        "sequential": pictures.sequential_legend(),
        "hatch": pictures.hatch_legend(),
    }


def _text(path: Traversable) -> str:
    return path.read_text(encoding="utf-8")
