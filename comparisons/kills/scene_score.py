"""What a scene is worth: the faults that it finds, and the pixels that it needs for that."""

from __future__ import annotations

from typing import TYPE_CHECKING

from raytruth.comparisons.kills.kill_run import kill_results
from raytruth.comparisons.matrix.quick_suite import small
from raytruth.comparisons.records.leaderboard import SceneScore

if TYPE_CHECKING:
    from raytruth.comparisons.kills.kill_matrix import SceneKills
    from raytruth.scenes.scene import Scene


def scene_score(name: str, scene: Scene, kills: SceneKills) -> SceneScore:
    """The score of somebody's scene, from what all faults and variants did on it.

    Its pixels are those of the image that it was judged by, which has no more than 300.
    """
    results = kill_results([kills], 0.0)
    camera = small(scene).camera
    killed = tuple(sorted(fault.name for fault in results.faults if fault.killed))
    return SceneScore(
        name=name,
        scene=scene.name,
        killed=len(killed),
        faults=len(results.faults),
        pixels=camera.width * camera.height,
        killed_by_it=killed,
        missed=tuple(sorted(results.survivors)),
        false_alarms=tuple(sorted(results.false_alarms)),
    )
