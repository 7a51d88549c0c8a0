"""Blender's `mathutils.bvhtree`: run as `python -P -m raytruth.comparisons.court.workers.blender`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from raytruth.comparisons.court.questions import MISSED, Answer, read_questions, write_answers

if TYPE_CHECKING:
    from raytruth.comparisons.court.questions import Question


def answer(question: Question) -> Answer | None:
    """The first hit of the question's ray, or None for another shape than triangles."""
    if not question.triangles:
        return None
    corners = np.array(question.triangles).reshape(-1, 3).tolist()
    faces = np.arange(len(corners)).reshape(-1, 3).tolist()
    tree = BVHTree.FromPolygons(corners, faces, all_triangles=True, epsilon=0.0)
    _, _, primitive, distance = tree.ray_cast(question.origin, question.direction)
    if primitive is None:
        return MISSED
    # It makes directions unit vectors.
    return Answer(hit=True, distance=distance / float(np.linalg.norm(question.direction)), primitive=int(primitive))


if __name__ == "__main__":
    write_answers(bpy.app.version_string, [answer(question) for question in read_questions()])
