"""POV-Ray 3.7 as a renderer: the program of the package `povray`, which traces Whitted's ray tree."""

from __future__ import annotations

import functools
import re
import shutil
import subprocess
import time
from typing import TYPE_CHECKING

import numpy as np
import OpenImageIO

from raytruth.comparisons.error_models.error_model import ErrorModel
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.comparisons.processes.isolation import run_isolated
from raytruth.comparisons.records.renderings import RendererError, Rendering
from raytruth.comparisons.renderers.protocol import Integrator
from raytruth.scenes.exporters.povray import SCENE_FILE, export_povray, options_of
from raytruth.scenes.exporters.povray_limits import FARTHEST, LARGEST_UNIT, refuses
from raytruth.scenes.light_paths import WHITTED

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from raytruth.comparisons.records.renderings import Image, Rays
    from raytruth.scenes.scene import Scene

# All files are those of POV-Ray's source at version 3.7.0.10, under source/backend.

# Rays are float64 (DBL in frame.h). As for closed_form, 8 of their 53 bits are left for another order of operations.
RAY_BITS = 53 - 8
# Interior::IOR is a float (SNGL in frame.h).
INDEX_BITS = 24
# Hits nearer than MIN_ISECT_DEPTH to where a ray starts are ignored (configbackend.h line 170; render/trace.cpp,
# `FindIntersection`). Those of spheres and triangles ignore 1e-6 by themselves, which is less. Our lengths are
# multiplied by the exporter's unit, which is smaller only for scenes larger than LARGEST_EXTENT.
MINIMUM_DISTANCE = 1e-4 / LARGEST_UNIT
# What throws a shadow must be farther than SHADOW_TOLERANCE from the point and from the light (render/trace.cpp
# line 66, `TracePointLightShadowRay`), unless it threw the last one, too: then MIN_ISECT_DEPTH and 0 suffice.
SHADOW_TOLERANCE = 1e-3 / LARGEST_UNIT
LARGEST_EXTENT = FARTHEST / LARGEST_UNIT
# Planes farther than FARTHEST are missed (shape/planes.cpp, `Plane::Intersect`). So are nearer ones that a ray meets at
# a sine under EPSILON = 1e-10; such a ray starts within 1e-3 units of the plane, and that is not modelled.
# Colours are float32 (COLC in base/types.h), and so are all numbers of a finish. On its way to the picture a colour is
# rounded by at most 12 operations at the surface that is lit, 2 more a light, and 8 at each reflection or refraction:
# weight, medium, product, sum, and the three of an average. That is under 2^7 for the 12 bounces that the exporter
# allows, as long as there are no more than 10 lights, each of which adds its own rounding to the sum only.
# 1 - R and the filters of the attenuations are rounded in units of 1, not of the colour.
COLOR_ERROR = 2.0**7 * 2.0**-24

# The exposures go down to 2^-40: a light of 1e12, the largest number of a scene, is not clipped there.
DARKEST = 40
LARGEST_CODE = 65535
# A 512x512 scene of some thousand triangles takes seconds; a hang must not stop a run for long.
TIME_LIMIT = 300.0
# Of address space; the largest mesh takes under 1 GB.
MEMORY_LIMIT = 8 << 30
PICTURE_FILE = "picture.png"


class PovRay:
    """POV-Ray's program, obeying the protocol Renderer."""

    name = "povray"
    integrators = (Integrator("whitted", WHITTED, has_depth=True),)
    error_model = ErrorModel(
        description="float64 for rays, float32 for colours, 16-bit pictures (POV-Ray 3.7)",
        precision_bits=RAY_BITS,
        ray_offset=RayOffset(minimum_distance=MINIMUM_DISTANCE, excludes_surface=False),
        shadow_tolerance=SHADOW_TOLERANCE,
        largest_extent=LARGEST_EXTENT,
        farthest=LARGEST_EXTENT,
        index_bits=INDEX_BITS,
        # source/base/image/encoding.h, `IntEncode`: floor(clip(x, 0, 1)·65535 + 0.5).
        output=OutputModel("uint16", bracketed=True, color_error=COLOR_ERROR),
    )
    error_models = (("POV-Ray 3.7.0.*", error_model),)  # all are corrections of one release
    install = "apt install povray"

    def version(self) -> str | None:
        """The version as the program tells it, or None where there is none."""
        return _version()

    def refuses(self, scene: Scene) -> str | None:
        """Why POV-Ray cannot express this scene, in one clause; None if it can."""
        return refuses(scene)

    def is_stochastic(self, scene: Scene, integrator: str) -> bool:  # noqa: ARG002 - the protocol's signature
        """Never: no surface is rough, no light has a size."""
        return False

    def render(self, scene: Scene, integrator: str, depth: int, rays: Rays, folder: Path) -> Rendering:  # noqa: ARG002 - it shoots its own rays for the same camera
        """Render in a process of its own, at smaller and smaller exposures until nothing is clipped; `depth` bounces.

        The scene file at exposure 1, the last log and the last picture stay in `folder`. Raises RendererError.
        """
        start = time.perf_counter()
        scene = scene.model_copy(update={"max_depth": depth})
        size = (scene.camera.height, scene.camera.width, 3)
        image = np.full(size, np.nan)
        for halvings in range(DARKEST + 1):
            exposure = 2.0**-halvings
            codes = _codes(scene, exposure, folder)
            if codes.shape != size:
                raise RendererError(f"expected a picture of shape {size}, got {codes.shape}")
            image = np.where(np.isnan(image) & (codes < LARGEST_CODE), codes / (LARGEST_CODE * exposure), image)
            if not np.isnan(image).any():
                break
        export_povray(scene, folder)
        return Rendering(_whole(image), time.perf_counter() - start)


def _codes(scene: Scene, exposure: float, folder: Path) -> NDArray[np.uint16]:
    """The numbers of the picture; one of an earlier run must not be taken for this."""
    (folder / PICTURE_FILE).unlink(missing_ok=True)
    export_povray(scene, folder, exposure=exposure)
    # Each thread takes some address space, and these pictures are small.
    command = ["povray", f"+I{SCENE_FILE}", f"+O{PICTURE_FILE}", "+WT1", *options_of(scene)]
    run_isolated(command, folder, seconds=TIME_LIMIT, memory_bytes=MEMORY_LIMIT)
    source = OpenImageIO.ImageInput.open(str(folder / PICTURE_FILE))
    if source is None:
        raise RendererError(f"POV-Ray's {PICTURE_FILE} cannot be read: {OpenImageIO.geterror()}")
    try:
        pixels = source.read_image("uint16") if str(source.spec().format) == "uint16" else None
        if pixels is None or source.has_error:
            raise RendererError(f"POV-Ray's {PICTURE_FILE} is no whole picture of 16 bits: {source.geterror()}")
    finally:
        source.close()
    return np.asarray(pixels, dtype=np.uint16)


def _whole(image: NDArray[np.float64]) -> Image:
    """What is clipped at any exposure is infinite."""
    return np.where(np.isnan(image), np.inf, image).astype(np.float32)


@functools.cache
def _version() -> str | None:
    """The program's own word."""
    program = shutil.which("povray")
    if program is None:
        return None
    try:
        told = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=20, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return None
    found = re.search(r"^POV-Ray (\d\S*)", told.stdout + told.stderr, re.MULTILINE)
    return f"POV-Ray {found[1]}" if found else None
