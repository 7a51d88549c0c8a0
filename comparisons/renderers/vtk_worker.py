"""The child process of the VTK adapter: reads its job in the current folder and writes `result.npz` there.

Run as `python -P -m comparisons.renderers.vtk_worker`. It alone imports VTK, which may end its process.
"""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

# The error model is that of Mesa's software rasteriser, which runs everywhere: no screen, and no graphics card. Both
# are looked up when VTK makes its window.
os.environ.pop("DISPLAY", None)
os.environ["LIBGL_ALWAYS_SOFTWARE"] = "1"

import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkRenderingCore import vtkPolyDataMapper

from comparisons.renderers.vtk_job import JOB_FILE, RESULT_FILE, TASK_FILE, Job

Array = NDArray[Any]


def main() -> None:
    """Do the job in the current folder."""
    job = Job.model_validate_json(Path(JOB_FILE).read_bytes())
    with np.load(TASK_FILE, allow_pickle=False) as task:
        triangles = task["triangles"]
    start = time.perf_counter()
    mesh = mesh_of(triangles)
    plotter = plotter_of(job, mesh)
    result = {"primitive": drawn_primitives(plotter), "depth": drawn_depths(plotter, job), "normals": normals_of(mesh)}
    result["seconds"] = np.array(time.perf_counter() - start)
    result["version"] = np.array(version_of(plotter))
    plotter.close()
    write_whole(result)


def write_whole(result: dict[str, Array]) -> None:
    """Write the result so that a killed process leaves none rather than half of one."""
    unfinished = Path(f"unfinished-{RESULT_FILE}")
    np.savez(unfinished, allow_pickle=False, **result)
    unfinished.replace(RESULT_FILE)


def mesh_of(triangles: Array) -> pyvista.PolyData:
    """The triangles, each coloured with its number plus one, in base 256."""
    corners = np.arange(3 * len(triangles)).reshape(-1, 3)
    mesh = pyvista.PolyData.from_regular_faces(triangles.reshape(-1, 3), corners)
    numbers = np.arange(1, len(triangles) + 1)
    mesh.cell_data["number"] = np.stack([numbers >> shift & 255 for shift in (0, 8, 16)], axis=1).astype(np.uint8)
    mesh.cell_data.active_scalars_name = "number"
    return mesh


def plotter_of(job: Job, mesh: pyvista.PolyData) -> pyvista.Plotter:
    """A window off screen in which the mesh has been drawn: its colours as they are, over black."""
    plotter = pyvista.Plotter(off_screen=True, window_size=[job.width, job.height], lighting="none")
    plotter.background_color = "black"
    plotter.disable_anti_aliasing()
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetScalarModeToUseCellData()
    mapper.SetColorModeToDirectScalars()
    mapper.SetVBOShiftScaleMethod(0)  # else VTK moves and scales what it draws, which rounds otherwise
    actor = pyvista.Actor(mapper=mapper)
    actor.prop.lighting = False
    plotter.add_actor(actor, reset_camera=False, render=False)
    camera = plotter.camera
    camera.position, camera.focal_point, camera.up = job.position, job.look_at, job.up
    camera.parallel_projection = job.view_angle is None
    camera.parallel_scale = job.view_height / 2
    if job.view_angle is not None:
        camera.view_angle = job.view_angle
    plotter.camera_set = True
    camera.clipping_range = (job.near, job.far)
    plotter.show(auto_close=False, interactive=False)
    camera.clipping_range = (job.near, job.far)  # showing it sets other ones
    plotter.render()
    return plotter


def drawn_primitives(plotter: pyvista.Plotter) -> Array:
    """The number of the triangle at each pixel, -1 for none, row 0 on top."""
    colors = plotter.screenshot(return_img=True).astype(np.int64)
    return np.asarray(colors[..., 0] + (colors[..., 1] << 8) + (colors[..., 2] << 16) - 1)


def drawn_depths(plotter: pyvista.Plotter, job: Job) -> Array:
    """Along the forward direction, from the z-buffer."""
    values = vtkFloatArray()
    plotter.render_window.GetZbufferData(0, 0, job.width - 1, job.height - 1, values)
    z: Array = vtk_to_numpy(values).reshape(job.height, job.width)[::-1].astype(np.float64)
    if job.view_angle is None:
        return np.asarray(job.near + z * (job.far - job.near))
    return 1 / (1 / job.near - z * (1 / job.near - 1 / job.far))


def normals_of(mesh: pyvista.PolyData) -> Array:
    """VTK's own normals of the triangles, on the side from which their corners run counterclockwise."""
    filtered = mesh.compute_normals(
        cell_normals=True,
        point_normals=False,
        split_vertices=False,
        consistent_normals=False,
        auto_orient_normals=False,
        non_manifold_traversal=False,
    )
    return np.asarray(filtered.cell_data["Normals"], dtype=np.float64)


def version_of(plotter: pyvista.Plotter) -> str:
    """Of pyvista, VTK, and what VTK draws with. Raises RuntimeError where that is not llvmpipe."""
    capabilities = dict(
        line.split(": ", 1) for line in plotter.render_window.ReportCapabilities().splitlines() if ": " in line
    )
    drawn_with = capabilities.get("OpenGL renderer string", "unknown").strip()
    if not drawn_with.startswith("llvmpipe"):
        raise RuntimeError(f"VTK draws with {drawn_with} here, and the error model is that of Mesa's llvmpipe")
    mesa = capabilities.get("OpenGL version string", "").partition("Mesa")[2].strip()
    vtk = ".".join(str(number) for number in pyvista.vtk_version_info)
    return f"pyvista {pyvista.__version__}, VTK {vtk}, Mesa {mesa}"


if __name__ == "__main__":
    main()
