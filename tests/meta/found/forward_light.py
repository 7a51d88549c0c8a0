"""Renders a scene by Mitsuba's `ptracer` with the samplers that are named, and prints the mean of each picture.

python tests/meta/found/forward_light.py SCENE SAMPLER…
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import mitsuba
import numpy as np

import raytruth
from raytruth.scenes.exporters.mitsuba import export_mitsuba

# A square, as the stratified sampler asks for, and no power of two.
SAMPLES = 9


def main(scene: str, *samplers: str) -> None:
    mitsuba.set_variant("scalar_rgb")
    with TemporaryDirectory() as name:
        file = export_mitsuba(raytruth.load_scene(scene), Path(name), integrator="ptracer", max_depth=2)
        written = file.read_text(encoding="utf-8")
        for sampler in samplers:
            file.write_text(written.replace('type="independent"', f'type="{sampler}"'), encoding="utf-8")
            picture = np.array(mitsuba.render(mitsuba.load_file(str(file)), spp=SAMPLES))
            print(sampler, f"{picture.mean():.4f}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
