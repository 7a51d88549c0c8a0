"""A window of VTK's, off screen, in which triangles are drawn. Only the child process of the adapter loads it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

# The error model is that of Mesa's software rasteriser, which runs everywhere: no screen, and no graphics card. Both
# are looked up when VTK makes its window.
os.environ.pop("DISPLAY", None)
os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"

import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkFloatArray, vtkUnsignedCharArray
from vtkmodules.vtkRenderingCore import vtkLight
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkFramebufferPass,
    vtkLightsPass,
    vtkOpaquePass,
    vtkRenderPassCollection,
    vtkSequencePass,
    vtkTextureObject,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

    from vtkmodules.vtkRenderingCore import vtkActor

    from raytruth.comparisons.renderers.vtk.job import Job, Lamp

Array = NDArray[Any]


class Window:
    """A camera and its framebuffer. Pictures are arrays of shape (height, width, …), row 0 on top."""

    def __init__(self, job: Job) -> None:
        self.job = job
        self.plotter = plotter = pyvista.Plotter(off_screen=True, window_size=[job.width, job.height], lighting="none")
        plotter.background_color = "black"
        plotter.disable_anti_aliasing()
        camera = plotter.camera
        camera.position, camera.focal_point, camera.up = job.position, job.look_at, job.up
        camera.parallel_projection = job.view_angle is None
        camera.parallel_scale = job.view_height / 2
        if job.view_angle is not None:
            camera.view_angle = job.view_angle
        plotter.camera_set = True
        plotter.show(auto_close=False, interactive=False)

    def draw(self, actors: Iterable[vtkActor]) -> None:
        """Draw these actors and nothing else."""
        renderer = self.plotter.renderer
        renderer.RemoveAllViewProps()
        for actor in actors:
            renderer.AddActor(actor)
        self.plotter.camera.clipping_range = (self.job.near, self.job.far)  # showing the window sets other ones
        self.plotter.render_window.Render()

    def colors(self) -> Array:
        """The picture that has been drawn, RGB with 8 bits a channel; shape (height, width, 3)."""
        values = vtkUnsignedCharArray()
        # Of the back buffer, which is all that a window off screen has.
        self.plotter.render_window.GetPixelData(0, 0, self.job.width - 1, self.job.height - 1, 0, values, 0)
        return np.asarray(vtk_to_numpy(values).reshape(self.job.height, self.job.width, 3)[::-1])

    def depths(self) -> Array:
        """Depths along the forward direction, from the z-buffer of what has been drawn; shape (height, width)."""
        job = self.job
        values = vtkFloatArray()
        self.plotter.render_window.GetZbufferData(0, 0, job.width - 1, job.height - 1, values)
        z: Array = vtk_to_numpy(values).reshape(job.height, job.width)[::-1].astype(np.float64)
        if job.view_angle is None:
            return np.asarray(job.near + z * (job.far - job.near))
        return 1 / (1 / job.near - z * (1 / job.near - 1 / job.far))

    def floats(self, actors: Iterable[vtkActor]) -> Array:
        """Draw actors into a framebuffer of float32, which clips no colour: RGB, shape (height, width, 3).

        Raises RuntimeError where there is no such framebuffer.
        """
        steps = vtkRenderPassCollection()
        steps.AddItem(vtkLightsPass())
        steps.AddItem(vtkOpaquePass())
        sequence = vtkSequencePass()
        sequence.SetPasses(steps)
        camera_pass = vtkCameraPass()
        camera_pass.SetDelegatePass(sequence)
        framebuffer = vtkFramebufferPass()
        framebuffer.SetDelegatePass(camera_pass)
        framebuffer.SetColorFormat(vtkTextureObject.Float32)
        framebuffer.SetDepthFormat(vtkTextureObject.Float32)
        self.plotter.renderer.SetPass(framebuffer)
        self.draw(actors)
        size = [self.job.width, self.job.height]
        picture = np.empty((*reversed(size), 4), dtype=np.float32)
        texture = framebuffer.GetColorTexture()
        drawn = (texture.GetWidth(), texture.GetHeight(), texture.GetVTKDataType())
        if drawn != (*size, VTK_FLOAT) or not texture.Download().Download2D(VTK_FLOAT, picture, size, 4, [0, 0]):
            raise RuntimeError(f"VTK drew {drawn} in place of float32 of {size}")
        self.plotter.renderer.SetPass(None)
        framebuffer.ReleaseGraphicsResources(self.plotter.render_window)
        return picture[::-1, :, :3]

    def light(self, lamps: Iterable[Lamp]) -> None:
        """Put these lamps into the window, and remove all others."""
        self.plotter.renderer.RemoveAllLights()
        self.plotter.renderer.AutomaticLightCreationOff()
        for lamp in lamps:
            self.plotter.renderer.AddLight(_light(lamp))

    def version(self) -> str:
        """Versions of pyvista, VTK, and what VTK draws with. Raises RuntimeError where that is not Mesa's llvmpipe."""
        capabilities = dict(
            line.split(": ", 1) for line in self.plotter.render_window.ReportCapabilities().splitlines() if ": " in line
        )
        drawn_with = capabilities.get("OpenGL renderer string", "unknown").strip()
        if not drawn_with.startswith("llvmpipe"):
            raise RuntimeError(f"VTK draws with {drawn_with} here, and the error model is that of Mesa's llvmpipe")
        mesa = capabilities.get("OpenGL version string", "").partition("Mesa")[2].strip()
        vtk = ".".join(str(number) for number in pyvista.vtk_version_info)
        return f"pyvista {pyvista.__version__}, VTK {vtk}, Mesa {mesa}"


def _light(lamp: Lamp) -> vtkLight:
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetDiffuseColor(*lamp.color)
    light.SetIntensity(1.0)
    light.SetAttenuationValues(*lamp.attenuation)
    if lamp.position is None:
        light.PositionalOff()
        # VTK has the way that it travels from where it is to its focal point.
        light.SetPosition(0.0, 0.0, 0.0)
        light.SetFocalPoint(*lamp.direction)
    else:
        light.PositionalOn()
        light.SetConeAngle(90.0)  # from which on it is no spot light
        light.SetPosition(*lamp.position)
    return light
