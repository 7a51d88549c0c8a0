"""Opens a scene with one lamp as glTF in VTK, and prints where the lamp is, how it falls off, and what is seen.

    python tests/meta/found/gltf_light.py SCENE

What is seen is a picture's lower left pixel in parts of its middle one: as VTK opens the file, with the lamp at its
node, and with the square of the distance, too.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

os.environ.pop("DISPLAY", None)
os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"  # Mesa's software renderer, which is there without a graphics card

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImport import vtkGLTFImporter
from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkWindowToImageFilter
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLRenderWindow  # noqa: F401 - what VTK draws with

import raytruth
from raytruth.scenes.exporters.gltf import export_gltf

# VTK writes the colours of physically based surfaces as the power 1/2.2 of what they are (vtkOpenGLPolyDataMapper).
GAMMA = 2.2


def corner_over_middle(window: vtkRenderWindow) -> float:
    """The radiance of the lower left pixel in parts of that in the middle, above and right of the centre."""
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    picture.Update()
    width, height = window.GetSize()
    codes = vtk_to_numpy(picture.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3)
    # VTK's first row is the lowest.
    return float((codes[0, 0, 0] / codes[height // 2, width // 2, 0]) ** GAMMA)


def opened(file: Path, size: tuple[int, int]) -> vtkRenderWindow:
    """A window, off screen, with what is in the file and no lamp besides, seen by the file's own camera."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*size)
    window.SetMultiSamples(0)
    importer = vtkGLTFImporter()
    importer.SetFileName(str(file))
    importer.SetRenderWindow(window)
    importer.SetCamera(0)
    importer.Update()
    window.GetRenderers().GetFirstRenderer().AutomaticLightCreationOff()
    return window


def main(scene_file: str) -> None:
    scene = raytruth.load_scene(scene_file)
    with TemporaryDirectory() as folder:
        window = opened(export_gltf(scene, Path(folder)), (scene.camera.width, scene.camera.height))
    lamp = window.GetRenderers().GetFirstRenderer().GetLights().GetItemAsObject(0)
    told = {"position": lamp.GetTransformedPosition(), "attenuation": lamp.GetAttenuationValues()}
    seen = [corner_over_middle(window)]
    lamp.SetPosition(0.0, 0.0, 0.0)
    seen.append(corner_over_middle(window))
    lamp.SetAttenuationValues(0.0, 0.0, 1.0)
    seen.append(corner_over_middle(window))
    print(json.dumps({**told, "seen": seen}))


if __name__ == "__main__":
    main(*sys.argv[1:])
