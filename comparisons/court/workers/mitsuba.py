"""Mitsuba 3: run as `python -P -m raytruth.comparisons.court.workers.mitsuba VARIANT`.

As it is published it asks Embree for triangles in all variants, in the fast mode; spheres and boxes are its own.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import mitsuba
import numpy as np

from raytruth.comparisons.court.questions import MISSED, Answer, read_questions, write_answers

if TYPE_CHECKING:
    from raytruth.comparisons.court.questions import Question


def answer(question: Question) -> Answer | None:
    """The first hit of the question's ray; of a box, whether the ray meets it."""
    ray = mitsuba.Ray3f(mitsuba.Point3f(*question.origin), mitsuba.Vector3f(*question.direction))
    if question.box is not None:
        low, high = (mitsuba.Point3f(*corner) for corner in question.box)
        met, _, farthest = mitsuba.BoundingBox3f(low, high).ray_intersect(ray)
        # It takes the whole line; its own tree then asks whether the stretch ends at 0 or later, as here.
        return Answer(hit=bool(_first(met)) and float(_first(farthest)) >= 0.0)
    scene = mitsuba.load_dict({"type": "scene", "shape": _shape(question)})
    hit = scene.ray_intersect_preliminary(ray)
    if not bool(_first(hit.is_valid())):
        return MISSED
    primitive = int(_first(hit.prim_index)) if question.triangles else None
    return Answer(hit=True, distance=float(_first(hit.t)), primitive=primitive)


def _shape(question: Question) -> Any:
    if question.sphere is not None:
        center, radius = question.sphere
        return {"type": "sphere", "center": list(center), "radius": radius}
    count = len(question.triangles)
    mesh = mitsuba.Mesh("triangles", 3 * count, count)
    parameters = mitsuba.traverse(mesh)
    parameters["vertex_positions"] = np.array(question.triangles, dtype=np.float32).ravel()
    parameters["faces"] = np.arange(3 * count, dtype=np.uint32)
    parameters.update()
    return mesh


def _first(value: Any) -> Any:
    """Compiled variants give arrays of one."""
    return np.ravel(np.array(value))[0]


if __name__ == "__main__":
    mitsuba.set_variant(sys.argv[1])
    write_answers(str(mitsuba.__version__), [answer(question) for question in read_questions()])
