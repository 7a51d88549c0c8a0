"""VTK's cell locator and box, both in float64: run as `python -P -m raytruth.comparisons.court.workers.vtk`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import mutable, vtkPoints, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkBox, vtkCellArray, vtkPolyData, vtkStaticCellLocator, vtkTriangle

from raytruth.comparisons.court.questions import MISSED, Answer, read_questions, write_answers

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from raytruth.comparisons.court.questions import Question


def answer(question: Question) -> Answer | None:
    """The first hit of the question's ray; of a box, whether the ray meets it; None for a sphere, which it meshes."""
    if question.box is not None:
        bounds = [part for sides in zip(*question.box, strict=True) for part in sides]
        line = np.multiply(_past_all(question, question.box), question.direction).tolist()
        distance: Any = mutable(0.0)
        met = vtkBox.IntersectBox(bounds, question.origin, line, [0.0] * 3, distance)
        return Answer(hit=met != "\0")  # a C++ char, which Python sees as a string
    if not question.triangles:
        return None
    locator = vtkStaticCellLocator()
    locator.SetDataSet(_triangles(question))
    locator.BuildLocator()
    length = _past_all(question, np.array(question.triangles).reshape(-1, 3))
    end = np.add(question.origin, length * np.array(question.direction)).tolist()
    part: Any = mutable(0.0)  # VTK writes into what its types call a number
    cell: Any = mutable(-1)
    unused: Any = mutable(0)
    # Without any tolerance, so that it says what its arithmetic gives.
    hit = locator.IntersectWithLine(question.origin, end, 0.0, part, [0.0] * 3, [0.0] * 3, unused, cell)
    return Answer(hit=True, distance=float(part) * length, primitive=int(cell)) if hit else MISSED


def _past_all(question: Question, corners: ArrayLike) -> float:
    """A t behind all corners: VTK has lines with ends."""
    reach = np.linalg.norm(np.subtract(corners, question.origin), axis=1).max()
    return float(2.0 * reach / np.linalg.norm(question.direction))


def _triangles(question: Question) -> vtkPolyData:
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.array(question.triangles).reshape(-1, 3), deep=True))
    cells = vtkCellArray()
    for number in range(len(question.triangles)):
        triangle = vtkTriangle()
        for corner in range(3):
            triangle.GetPointIds().SetId(corner, 3 * number + corner)
        cells.InsertNextCell(triangle)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


if __name__ == "__main__":
    write_answers(vtkVersion.GetVTKVersion(), [answer(question) for question in read_questions()])
