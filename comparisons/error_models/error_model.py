"""Error models: what a renderer declares about its arithmetic, and from which its tolerance is derived."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf, isfinite
from typing import TYPE_CHECKING, Literal

from raytruth.comparisons.error_models.departures import NONE, Departures
from raytruth.comparisons.error_models.handed_cameras import FieldOfView  # noqa: TC001 - a field's type
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.reference_tracer.camera_rays import CENTRES, CameraRays
from raytruth.scenes.extent import extent_of

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


@dataclass(frozen=True)
class RayOffset:
    """Where secondary and shadow rays start that leave a surface at p: at p + v·(absolute + relative·max|p|).

    v is the unit normal on the side that the ray goes to, or the ray's own unit direction. max|p| is the largest
    absolute coordinate. Raises ValueError for a combination that no renderer can have.
    """

    absolute: float = 0.0
    """A length in units of the scene."""
    relative: float = 0.0
    along: Literal["normal", "direction"] = "normal"
    minimum_distance: float = 0.0
    """Hits nearer than this to where a ray starts are ignored, a camera's ray included; in units of the scene."""
    excludes_surface: bool = True
    """Whether a ray cannot meet again the point that it leaves: by the identity of the primitive, or since the offset
    is far above all rounding. If not, the primitive is tested as all others are: of a sphere both roots."""
    is_bound: bool = False
    """Whether only some rays are moved, those that would miss the triangle that they leave, and by no more than that.
    So each coordinate of a ray's start may be off by anything up to that, to either side (bounded_offsets.py)."""

    def __post_init__(self) -> None:
        if min(self.absolute, self.relative, self.minimum_distance) < 0.0:
            raise ValueError("a ray offset is not negative")
        if self.is_bound and not (self.moves_rays and self.excludes_surface):
            raise ValueError(
                "a bound on an offset is above 0, and the surface is excluded, on whichever side a ray starts"
            )
        if self.excludes_surface and (self.minimum_distance > 0.0 or self.along == "direction"):
            raise ValueError("with a least distance, or an offset along the ray, a surface is tested as all others are")

    @property
    def moves_rays(self) -> bool:
        """Whether rays start beside the surface."""
        return self.absolute > 0.0 or self.relative > 0.0

    def in_words(self) -> str:
        """The offset as a clause for people, as in `raytruth renderers`."""
        start = f"{self._length()} along the {self._vector()}" if self.moves_rays else "on the surface"
        start = f"up to {start}, to either side" if self.is_bound else start
        nearest = f", hits nearer than {self.minimum_distance:.3g} are ignored" if self.minimum_distance > 0.0 else ""
        left = "cannot be hit again there" if self.excludes_surface else "is tested as all others are"
        return f"{start}{nearest}; the surface {left}"

    def _length(self) -> str:
        if self.absolute == self.relative:
            return f"{self.absolute:.3g}·(1 + max|p|)"
        terms = [f"{self.absolute:.3g}"] if self.absolute > 0.0 else []
        return " + ".join([*terms, *([f"{self.relative:.3g}·max|p|"] if self.relative > 0.0 else [])])

    def _vector(self) -> str:
        return "normal" if self.along == "normal" else "ray"


@dataclass(frozen=True)
class Rasterisation:
    """How triangles are drawn with a z-buffer; what that may do to a pixel is derived in rasterisation.py."""

    subpixel_bits: int
    """Corners are snapped to 2^-subpixel_bits of a pixel to tell what they cover."""
    depth_bits: int
    """Depths are kept to 2^-depth_bits of the way from the near to the far plane (view_volume.py)."""
    light_bits: int
    """As `precision_bits` of the error model, of the lighting equation: slack for another order of it included."""

    def in_words(self) -> str:
        """The rasterisation as a clause for people, as in `raytruth renderers`."""
        grid = f"with corners snapped to 2^-{self.subpixel_bits} of a pixel"
        buffer = f"in a z-buffer of {self.depth_bits} bits between planes tight around what is seen"
        return f"triangles {grid}, {buffer}; an operation of their light errs by at most 2^-{self.light_bits}"


@dataclass(frozen=True)
class ErrorModel:
    """How a renderer's result may differ from the truth by its arithmetic alone; the same for all scenes.

    But for what `largest_extent` says of large ones.
    """

    description: str
    precision_bits: int
    """The relative error of one operation is at most 2^-precision_bits, slack for another order of them included."""
    ray_offset: RayOffset = field(default_factory=RayOffset)
    shadow_shortening: float = 0.0
    """Shadow rays end at this fraction of the light's distance before the light."""
    shadow_tolerance: float = 0.0
    """What is nearer than this to a shadow ray's start, or to the light, may throw a shadow or none; 0: it does."""
    largest_extent: float = inf
    """Of scenes for which the least distance of hits and the shadow tolerance are as stated (`extent_of`). A renderer
    that has them in units of its own, and gets larger scenes in larger units, has them so many times longer there."""
    index_bits: int | None = None
    """Indices of refraction are rounded to this many bits when they are stored, if to fewer than all else."""
    triangle_test: Literal["watertight", "moeller-trumbore", "pluecker"] = "watertight"
    """Which formula decides whether a ray meets a triangle: the truth's own, or one of triangle_tests.py."""
    triangle_points: Literal["along the ray", "barycentric"] = "along the ray"
    """How the point is found where a ray meets a triangle: from its distance, or from its corners with the weights of
    the triangle test (hit_points.py)."""
    sphere_test: Literal["accurate", "from the foot", "from the foot, accurate for shadows"] = "accurate"
    """Which formula decides where a ray meets a sphere: the truth's own, or those of sphere_tests.py. The last has
    formulas of float64 for what a ray needs not to know the place of."""
    sphere_points: Literal["along the ray", "normalised", "put back"] = "along the ray"
    """How point and normal are found where a ray meets a sphere: p = o + t·d and (p - c)/r; this p, and p - c made a
    unit vector; or that and the point of the sphere that lies in its direction (hit_points.py)."""
    image_radius: float = 0.0
    """A pixel's ray may go through any point within so many pixels of its centre, in x and in y."""
    camera_rays: CameraRays = CENTRES
    """Through which point of each pixel its ray goes: the truth that it is held to is that of these rays."""
    field_of_view: FieldOfView = "vertical"
    """Which side of the image the angle belongs to that it is told of a camera (handed_cameras.py)."""
    departures: Departures = NONE
    """What it computes otherwise than the specification says, on purpose."""
    rasterisation: Rasterisation | None = None
    """How triangles are drawn; None where rays are traced."""
    output: OutputModel = field(default_factory=OutputModel)
    random_choices: str = ""
    """What it draws random numbers for; empty if nothing. The adapter tells for which scenes (`is_stochastic`)."""

    def __post_init__(self) -> None:
        if self.image_radius < 0.0:
            raise ValueError("an image radius is not negative")
        if self.triangle_points == "barycentric" and self.triangle_test == "watertight":
            raise ValueError("points are interpolated with the weights of one of the tests of triangle_tests.py")
        if self.sphere_points == "put back" and self.triangle_points != "barycentric":
            raise ValueError("points are put back on spheres by who interpolates those on triangles")
        if self.sphere_test != "accurate" and (self.ray_offset.is_bound or not self.ray_offset.excludes_surface):
            raise ValueError("spheres are tested from the foot by who leaves them as they are, or along their normal")
        nearest = self.ray_offset.minimum_distance
        if self.shadow_tolerance and (self.ray_offset.excludes_surface or self.shadow_tolerance < nearest):
            raise ValueError("a shadow tolerance is at least the least distance of hits, and excludes no surface")

    def in_scene(self, scene: Scene) -> ErrorModel:
        """The error model for this scene: lengths grow by the least power of two that makes room for its extent."""
        growth = 1.0
        while extent_of(scene) > self.largest_extent * growth:
            growth *= 2.0
        if growth == 1.0:
            return self
        offset = replace(self.ray_offset, minimum_distance=self.ray_offset.minimum_distance * growth)
        tolerance = self.shadow_tolerance * growth
        return replace(self, ray_offset=offset, shadow_tolerance=tolerance, largest_extent=self.largest_extent * growth)

    def of_light(self) -> ErrorModel:
        """The error model of colours: a rasteriser's light has an arithmetic of its own, other than its hits have."""
        if self.rasterisation is None or self.rasterisation.light_bits == self.precision_bits:
            return self
        return replace(self, precision_bits=self.rasterisation.light_bits)

    def in_words(self) -> dict[str, str]:
        """Each field as a clause for people, by the heading that it stands under in `raytruth renderers`."""
        shortened = f"{self.shadow_shortening:.3g} of the distance before the light"
        around = f"within {self.image_radius:.3g} pixels of a pixel's centre, in x and in y"
        near = f"{self.shadow_tolerance:.3g} from the surface or the light may throw a shadow or none"
        grows = f"where rays go farther than {self.largest_extent:.4g}, least distances are so many times longer"
        return {
            "summary": self.description,
            "arithmetic": f"one operation errs by at most 2^-{self.precision_bits} of its result",
            "camera rays go": around if self.image_radius > 0.0 else "through the centres of pixels",
            "what counts as centres": self.camera_rays.in_words(),
            "fields of view are": f"{self.field_of_view}, as they are told to it",
            "indices of refraction": f"stored with {self.index_bits or self.precision_bits} bits",
            "triangles": f"{self.triangle_test} test",
            "points on triangles": self.triangle_points,
            "spheres": f"{self.sphere_test} test",
            "points on spheres": self.sphere_points,
            "drawing": self.rasterisation.in_words() if self.rasterisation else "none: rays are traced",
            "rays that leave a surface start": self.ray_offset.in_words(),
            "shadow rays end": shortened if self.shadow_shortening > 0.0 else "at the light",
            "what is near": f"nearer than {near}" if self.shadow_tolerance > 0.0 else "throws shadows as all else",
            "large scenes": grows if isfinite(self.largest_extent) else "as all others",
            "output": self.output.in_words(),
            "random numbers": self.random_choices or "none",
            "departures from the specification": self.departures.in_words(),
        }
