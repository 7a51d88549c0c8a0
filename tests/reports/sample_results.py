"""A results directory with synthetic images: every verdict, odd names, missing parts, pixels that are not numbers."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from raytruth.comparisons.records.image_files import write_image
from raytruth.comparisons.records.pixel_evidence import PixelEvidence, read_pixel_evidence, write_pixel_evidence

if TYPE_CHECKING:
    from pathlib import Path

    from raytruth.comparisons.records.renderings import Image

HOSTILE = "<script>alert('x')</script>\"&{{ 7*7 }}"
ODD_NAME = "odd name/<b>%20ü"
SIDE = 64
FAILING_PIXEL = (20, 12)
"""x, y"""
AMBIGUOUS_PIXEL = (33, 50)
CAPPED_PIXEL = (34, 50)
DECLARED_PIXEL = (35, 50)
WAIVED = {"reason": "It takes <b>air</b> for glass.", "link": "https://example.org/fault?a=1&b=2"}

Names = tuple[str, str, str]
"""Scene, renderer, integrator."""


def write_sample(directory: Path) -> Path:
    """Write the results directory and return it."""
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "results.json").write_text(json.dumps(sample_document(directory)), encoding="utf-8")
    return directory


def sample_document(directory: Path) -> dict[str, Any]:
    """The content of results.json; writes the images and logs that it names."""
    scenes = ["lambert-sphere", "whitted-1980", ODD_NAME]
    return {
        "schema_version": 1,
        "raytruth_version": "0.1.0",
        "created": "2026-11-22T01:30:00+00:00",
        "command": "raytruth run --out results",
        "machine": {"system": "Linux x86-64", "processor": "2 cores", "python": "3.11.2"},
        "scenes": [_scene(name) for name in scenes],
        "renderers": [
            _renderer("reference", "0.1.0", {"whitted": "E S* D L"}),
            _renderer("mitsuba", "3.9.1", {"direct": "E D L", "path": "E (D|S){0,{depth}} L"}),
            _renderer("closed_form", "0.1.0", {"local": "E D L"}),
            _renderer("povray", None, {"trace": "E S* D L"}),
        ],
        "cells": [
            _passing(directory, ("lambert-sphere", "reference", "whitted")),
            _passing(directory, ("lambert-sphere", "mitsuba", "direct")),
            _stochastic(directory, ("lambert-sphere", "mitsuba", "path")),
            _failing(directory, ("lambert-sphere", "closed_form", "local")),
            _cell(("lambert-sphere", "povray", "trace"), "unavailable", "povray is not installed: apt install povray"),
            _passing(directory, ("whitted-1980", "reference", "whitted")),
            _cell(
                ("whitted-1980", "mitsuba", "direct"),
                "incomparable",
                "the scene has specular light paths (E S D L), which direct does not sum",
            ),
            _declared(directory, ("whitted-1980", "povray", "trace")),
            _crashed(directory, ("whitted-1980", "mitsuba", "path")),
            _failing(directory, ("whitted-1980", "closed_form", "local"), waived=WAIVED),
            _without_image(directory, (ODD_NAME, "mitsuba", "path")),
        ],
    }


def _scene(name: str) -> dict[str, Any]:
    return {
        "name": name,
        "purpose": "A diffuse sphere under one point light: the shading term alone, in a closed form.",
        "convention": "radiometric",
        "width": SIDE,
        "height": SIDE,
        "features": ["sphere", "lambert", "point light", "inverse square falloff"],
        "light_paths": "E D L",
    }


def _renderer(name: str, version: str | None, integrators: dict[str, str]) -> dict[str, Any]:
    model = "float32 with 20 significant bits left after reordering; secondary rays start 8.94e-5·(1 + max|p|) off"
    install = f"pip install {name}"
    record = {"name": name, "version": version, "install": install, "error_model": model, "integrators": integrators}
    return {**record, "family": None if name == "reference" else name}


def _cell(names: Names, verdict: str, reason: str, **more: Any) -> dict[str, Any]:
    scene, renderer, integrator = names
    command = f"raytruth run {scene} --renderer {renderer}/{integrator}"
    place = {"scene": scene, "renderer": renderer, "integrator": integrator}
    return {**place, "verdict": verdict, "reason": reason, "command": command, **more}


def _passing(directory: Path, names: Names) -> dict[str, Any]:
    truth = sphere_image()
    render = truth + noise()[..., None] * np.float32(1e-6)
    more = _evidence(directory, names, truth, render, np.abs(noise()))
    return _cell(names, "pass", "every judged pixel lies in its feasible set", **more)


def _stochastic(directory: Path, names: Names) -> dict[str, Any]:
    cell = _passing(directory, names)
    write_image(directory / _folder(names) / "variance.exr", np.abs(noise())[..., None].repeat(3, axis=-1))
    cell["images"]["variance"] = f"{_folder(names)}/variance.exr"
    cell["stochastic"] = {"samples": 1024, "batches": 16, "significance": 0.01, "smallest_p_value": 0.37}
    return cell


def _failing(directory: Path, names: Names, **more: Any) -> dict[str, Any]:
    truth = sphere_image()
    render = truth.copy()
    x, y = FAILING_PIXEL
    render[y - 6 : y + 6, x - 6 : x + 6] *= np.float32(0.5)
    render[40, 40:43] = np.nan
    tolerances = np.abs(noise())
    tolerances[y - 6 : y + 6, x - 6 : x + 6] = 300
    tolerances[40, 40:43] = np.inf
    tolerances[:, :8] = -1
    more |= _evidence(directory, names, truth, render, tolerances)
    return _cell(names, "fail", "147 of 4,096 pixels lie outside their feasible sets", **more)


def _declared(directory: Path, names: Names) -> dict[str, Any]:
    cell = _passing(directory, names)
    x, y = DECLARED_PIXEL
    cell["judgement"]["declared"] = {"count": 1, "largest_difference": 0.505, "pixels": [(x, y)]}
    path = directory / cell["images"]["feasible"]
    evidence = read_pixel_evidence(path)
    evidence.declared[y, x] = True
    write_pixel_evidence(path, evidence)
    reason = f"1 of 4096 pixels are as declared, not as due: up to 0.505 from the truth, at ({x}, {y})"
    return {**cell, "verdict": "declared", "reason": reason}


def _crashed(directory: Path, names: Names) -> dict[str, Any]:
    log = directory / _folder(names) / "log.txt"
    log.parent.mkdir(parents=True, exist_ok=True)
    lines = [f"line {i}" for i in range(200)]
    log.write_text("\n".join([*lines, "\x1b[31mFatal: <b>fminimum</b>\x1b[0m \x07", "last line"]), encoding="utf-8")
    return _cell(names, "error", "mitsuba ended with signal 6 after 0.4 s", log=f"{_folder(names)}/log.txt")


def _without_image(directory: Path, names: Names) -> dict[str, Any]:
    cell = _passing(directory, names)
    (directory / cell["images"]["render"]).unlink()
    return {**cell, "log": "cells/nowhere/log.txt"}


def _evidence(directory: Path, names: Names, truth: Image, render: Image, tolerances: Image) -> dict[str, Any]:
    failing = int((~(tolerances <= 1)).sum())
    return {
        "largest_error": float(np.nanmax(np.abs(render - truth))),
        "seconds": 0.0421,
        "version": "3.9.1",
        "judgement": {
            "pixels": SIDE**2,
            "failing": failing,
            "unjudged": 512,
            "capped": 1,
            "ambiguous": 37,
            "worst": _worst(truth, render, 300 * bool(failing)),
        },
        "first_hits": {
            "compared": 4059,
            "primitive_mismatches": 0,
            "ambiguous": 37,
            "failing": 0,
            "largest_depth_error": 2.4e-7,
            "largest_position_error": 5.1e-7,
            "largest_normal_error": 3.3e-7,
        },
        "metrics": {
            "largest_difference": 1.2e-6,
            "mean_difference": -3.1e-8,
            "rmse": 2.2e-7,
            "psnr": 121.4,
            "ssim": 1.0,
        },
        "images": _written(directory, _folder(names), truth, render, tolerances),
    }


def _worst(truth: Image, render: Image, tolerances: float) -> dict[str, Any]:
    x, y = FAILING_PIXEL
    centre = truth[y, x].tolist()
    bounds = {"low": [c - 1e-6 for c in centre], "high": [c + 1e-6 for c in centre]}
    return {"x": x, "y": y, "value": render[y, x].tolist(), "truth": centre, **bounds, "tolerances": tolerances}


def _written(directory: Path, folder: str, truth: Image, render: Image, tolerances: Image) -> dict[str, str]:
    """The paths of a cell's images in the results, which are written there."""
    (directory / folder).mkdir(parents=True, exist_ok=True)
    paths = {}
    of_channels = tolerances[..., None] * np.array([0.5, 1, 0.25]) if (tolerances >= 0).all() else tolerances[..., None]
    distances = np.broadcast_to(of_channels, truth.shape)
    for kind, image in {"truth": truth, "render": render, "tolerances": distances}.items():
        paths[kind] = f"{folder}/{kind}.exr"
        write_image(directory / paths[kind], np.ascontiguousarray(image, dtype=np.float32))
    paths["feasible"] = f"{folder}/feasible.exr"
    write_pixel_evidence(directory / paths["feasible"], _pixel_evidence(truth, tolerances))
    return paths


def _pixel_evidence(truth: Image, tolerances: Image) -> PixelEvidence:
    """A narrow box around the truth; three of them at the ambiguous pixel, of which the value is in the second."""
    low = np.full((SIDE, SIDE, 3, 3), np.nan, dtype=np.float32)
    low[:, :, 0] = truth - np.float32(2e-6)
    nearest = np.zeros((SIDE, SIDE), dtype=np.int64)
    x, y = AMBIGUOUS_PIXEL
    low[y, x] = low[y, x, 0] + np.float32(0.25) * np.array([[-1], [0], [1]], dtype=np.float32)
    nearest[y, x] = 1
    low[tolerances < 0] = np.nan
    merged = np.zeros((SIDE, SIDE), dtype=bool)
    merged[CAPPED_PIXEL[1], CAPPED_PIXEL[0]] = True
    return PixelEvidence(low, low + np.float32(4e-6), nearest, merged, np.zeros_like(merged))


def _folder(names: Names) -> str:
    scene, renderer, integrator = (name.replace("/", "-") for name in names)
    return f"cells/{scene}/{renderer}-{integrator}"


def sphere_image() -> Image:
    """A shaded sphere before a dim background, shape (SIDE, SIDE, 3)."""
    y, x = (np.indices((SIDE, SIDE)) + 0.5) / SIDE * 2 - 1
    height = np.sqrt(np.maximum(0.64 - x**2 - y**2, 0))
    shading = np.where(height > 0, np.maximum(0, (height - 0.6 * x - 0.7 * y) / 1.4), 0)
    colour = shading[..., None] * np.array([0.9, 0.6, 0.3]) + 0.02
    image: Image = colour.astype(np.float32)
    return image


def noise() -> Image:
    """The same noise each time, in -1..1, shape (SIDE, SIDE)."""
    values: Image = np.random.default_rng(1).uniform(-1, 1, (SIDE, SIDE)).astype(np.float32)
    return values
