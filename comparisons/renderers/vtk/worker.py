"""The child process of the VTK adapter: reads its job in the current folder and writes `result.npz` there.

Run as `python -P -m raytruth.comparisons.renderers.vtk.worker`. It alone imports VTK, which may end its process.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
from numpy.typing import NDArray
from vtkmodules.vtkCommonCore import vtkInformation
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper
from vtkmodules.vtkRenderingOpenGL2 import vtkLightingMapPass

from raytruth.comparisons.processes.worker_results import write_arrays
from raytruth.comparisons.renderers.vtk.job import JOB_FILE, RESULT_FILE, TASK_FILE, Job, Lamp, Surface
from raytruth.comparisons.renderers.vtk.window import Window

Array = NDArray[Any]

# Without any, VTK's shader has no normals.
BLACK_LAMP = Lamp(position=None, direction=(0.0, 0.0, -1.0), color=(0.0, 0.0, 0.0), attenuation=(1.0, 0.0, 0.0))


def main() -> None:
    """Do the job in the current folder."""
    job = Job.model_validate_json(Path(JOB_FILE).read_bytes())
    with np.load(TASK_FILE, allow_pickle=False) as task:
        triangles, surface = task["triangles"], task["surface"]
    start = time.perf_counter()
    window = Window(job)
    if job.draws == "light":
        result = {"image": drawn_light(window, triangles, surface)}
    else:
        result = drawn_first_hits(window, triangles)
    result["seconds"] = np.array(time.perf_counter() - start)
    result["version"] = np.array(window.version())
    window.plotter.close()
    write_arrays(Path(RESULT_FILE), result)


def drawn_first_hits(window: Window, triangles: Array) -> dict[str, Array]:
    """Numbers and depths in one picture, normals in view coordinates in another, and those of all triangles."""
    mesh = mesh_of(triangles)
    window.draw([numbered_actor(mesh)])
    colors = window.colors().astype(np.int64)
    primitive = colors[..., 0] + (colors[..., 1] << 8) + (colors[..., 2] << 16) - 1
    depth = window.depths()
    window.light([BLACK_LAMP])
    # VTK shows a normal n as (n + 1)/2.
    drawn_normal = 2 * window.floats([normals_actor(mesh)]).astype(np.float64) - 1
    normals = np.asarray(mesh.cell_data["Normals"], dtype=np.float64)
    return {"primitive": primitive, "depth": depth, "drawn_normal": drawn_normal, "normals": normals}


def drawn_light(window: Window, triangles: Array, surface: Array) -> Array:
    """The picture of all surfaces in the job's light, linear RGB in float32, shape (height, width, 3)."""
    job = window.job
    window.light(job.lamps)
    window.plotter.renderer.SetBackground(*job.background)
    actors = [
        lit_actor(mesh_of(triangles[surface == number]), colors)
        for number, colors in enumerate(job.surfaces)
        if (surface == number).any()
    ]
    return window.floats(actors)


def mesh_of(triangles: Array) -> pyvista.PolyData:
    """The triangles, with VTK's own normals of them, on the side from which their corners run counterclockwise."""
    corners = np.arange(3 * len(triangles)).reshape(-1, 3)
    mesh = pyvista.PolyData.from_regular_faces(triangles.reshape(-1, 3), corners)
    return mesh.compute_normals(
        cell_normals=True,
        point_normals=False,
        split_vertices=False,
        consistent_normals=False,
        auto_orient_normals=False,
        non_manifold_traversal=False,
    )


def actor_of(mesh: pyvista.PolyData) -> tuple[vtkActor, vtkPolyDataMapper]:
    """An actor of flat triangles where they are: VTK may move and scale what it draws, which rounds otherwise."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    mapper.SetVBOShiftScaleMethod(0)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetInterpolationToFlat()
    return actor, mapper


def numbered_actor(mesh: pyvista.PolyData) -> vtkActor:
    """Each triangle in the colour of its number plus one, in base 256, without light."""
    numbers = np.arange(1, mesh.n_cells + 1)
    mesh.cell_data["number"] = np.stack([numbers >> shift & 255 for shift in (0, 8, 16)], axis=1).astype(np.uint8)
    mesh.cell_data.active_scalars_name = "number"
    actor, mapper = actor_of(mesh)
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseCellData()
    mapper.SetColorModeToDirectScalars()
    actor.GetProperty().LightingOff()
    return actor


def normals_actor(mesh: pyvista.PolyData) -> vtkActor:
    """Each triangle in the colour of the normal that VTK lights it with."""
    actor, _ = actor_of(mesh)
    shown = vtkInformation()
    shown.Set(vtkLightingMapPass.RENDER_NORMALS(), 1)
    actor.SetPropertyKeys(shown)
    return actor


def lit_actor(mesh: pyvista.PolyData, surface: Surface) -> vtkActor:
    """Triangles of one material."""
    actor, _ = actor_of(mesh)
    colors = actor.GetProperty()
    for coefficient in (colors.SetAmbient, colors.SetDiffuse, colors.SetSpecular):
        coefficient(1.0)
    colors.SetAmbientColor(*surface.ambient)
    colors.SetDiffuseColor(*surface.diffuse)
    colors.SetSpecularColor(*surface.specular)
    colors.SetSpecularPower(surface.exponent)
    return actor


if __name__ == "__main__":
    main()
