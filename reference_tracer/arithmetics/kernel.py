"""What Python calls of a kernel: a kernel is the tracer's source in one number type, its functions as attributes.

A kernel that is compiled has `render_rows` and `first_hit_rows` alone, since every entry point costs time to compile.
One that is not has every function of the source that its features need; what else is called from outside is named here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from raytruth.reference_tracer.source.scene_data import SceneData

Number = Any
"""A number of the kernel's number type."""
Triple = tuple[Number, Number, Number]
"""A point, a direction, or a colour in linear RGB."""
Frame = tuple[Triple, ...]
"""Five: the camera's position, a corner of its image plane, a pixel's two sides, and forward (source/camera.py)."""
Ray = tuple[Any, ...]
"""Origin, direction, weight, primitive that it leaves, medium, and depth left (source/ray_tree.py)."""


class Kernel(Protocol):
    """The functions of a kernel; each is the source's function of that name, and described there."""

    nearest_hit: Callable[[SceneData, Triple, Triple, int], tuple[Number, int]]
    """An attribute that may be set, since what wraps it may save work (feasible_sets/asked_once.py)."""
    is_occluded: Callable[[SceneData, Triple, Triple, int, Number], bool]
    """As above; only in kernels of scenes with lights."""

    def camera_frame(self, scene: SceneData, /) -> Frame:
        """See source/camera.py."""

    def primary_ray(self, frame: Frame, x: Number, y: Number, /) -> tuple[Triple, Triple]:
        """See source/camera.py."""

    def radiance_at(self, scene: SceneData, frame: Frame, x: Number, y: Number, /) -> Triple:
        """See source/pixel_rows.py."""

    def render_rows(self, scene: SceneData, samples: int, first: int, end: int, image: NDArray[Any], /) -> None:
        """See source/pixel_rows.py."""

    def first_hit_rows(
        self, scene: SceneData, first: int, end: int, depths: NDArray[Any], primitives: NDArray[Any], /
    ) -> None:
        """See source/pixel_rows.py."""

    def trace_ray(self, scene: SceneData, ray: Ray, waiting: list[Ray], /) -> Triple:
        """See source/ray_tree.py."""

    def hit_point(
        self, scene: SceneData, origin: Triple, direction: Triple, distance: Number, primitive: int, /
    ) -> Triple:
        """See source/ray_tree.py."""

    def surface_normal(self, scene: SceneData, primitive: int, point: Triple, /) -> Triple:
        """See source/traversal.py."""

    def rows_of(self, scene: SceneData, table: int, /) -> int:
        """See source/scene_data.py."""

    def add(self, a: Triple, b: Triple, /) -> Triple:
        """See source/vector.py."""

    def dot(self, a: Triple, b: Triple, /) -> Number:
        """See source/vector.py."""

    def normalize(self, a: Triple, /) -> Triple:
        """See source/vector.py."""

    def along(self, origin: Triple, direction: Triple, distance: Number, /) -> Triple:
        """See source/vector.py."""
