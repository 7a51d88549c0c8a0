"""Embree, fast or robust: run as `python -P -m raytruth.comparisons.court.workers.embree fast|robust`."""

from __future__ import annotations

import sys
from importlib.metadata import version
from typing import TYPE_CHECKING

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

from raytruth.comparisons.court.questions import MISSED, Answer, read_questions, write_answers

if TYPE_CHECKING:
    from raytruth.comparisons.court.questions import Question


def answer(question: Question, *, robust: bool) -> Answer | None:
    """The first hit of the question's ray, or None for another shape than triangles."""
    if not question.triangles:
        return None
    scene = EmbreeScene(robust=robust)
    mesh = TriangleMesh(scene, np.array(question.triangles, dtype=np.float32))
    ray = [np.array([vector], dtype=np.float32) for vector in (question.origin, question.direction)]
    found = scene.run(*ray, output=True)
    del mesh  # it had to live as long as the scene
    primitive = int(found["primID"][0])
    if primitive < 0:
        return MISSED
    return Answer(hit=True, distance=float(found["tfar"][0]), primitive=primitive)


if __name__ == "__main__":
    is_robust = sys.argv[1] == "robust"
    write_answers(version("embreex"), [answer(question, robust=is_robust) for question in read_questions()])
