"""Error models: what a renderer declares about its arithmetic, and from which its tolerance is derived."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf, isfinite
from typing import TYPE_CHECKING, Literal

from raytruth.comparisons.error_models.departures import NONE, Departures
from raytruth.comparisons.error_models.formulas import in_code
from raytruth.comparisons.error_models.handed_cameras import FieldOfView  # noqa: TC001 - a field's type
from raytruth.comparisons.error_models.output_model import OutputModel
from raytruth.comparisons.error_models.rasterisers.rasterisation_model import Rasterisation  # noqa: TC001 - a field's type
from raytruth.comparisons.error_models.ray_offset_model import RayOffset
from raytruth.reference_tracer.camera_rays import CENTRES, CameraRays
from raytruth.scenes.extent import extent_of

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene


TriangleTest = Literal[
    "watertight", "moeller-trumbore", "pluecker", "moeller-trumbore of 1997", "cramer", "plane and inside"
]


AIMS = {
    "light": "from their start to the light",
    "parallel": "in the direction from the surface to the light",
    "either": "to the light, or in the direction from the surface to it",
}


@dataclass(frozen=True)
class ErrorModel:
    """How a renderer's result may differ from the truth by its arithmetic alone; the same for all scenes.

    But for what `largest_extent` says of large ones.
    """

    description: str
    precision_bits: int
    """The relative error of one operation is at most 2^-precision_bits, slack for another order of them included."""
    ray_offset: RayOffset = field(default_factory=RayOffset)
    """Of all rays that leave a surface, but for the three below; camera rays have its least distance."""
    shadow_shortening: float = 0.0
    """Shadow rays end at this fraction of the light's distance before the light."""
    shadow_tolerance: float = 0.0
    """What is nearer than this to a shadow ray's start, or to the light, may throw a shadow or none; 0: it does."""
    largest_extent: float = inf
    """Of scenes for which the least distance of hits and the shadow tolerance are as stated (`extent_of`). A renderer
    that has them in units of its own, and gets larger scenes in larger units, has them so many times longer there."""
    farthest: float = inf
    """In scenes with infinite planes, which have no extent: what is farther than this from where a ray starts may be
    met or not. It grows as the least distance does."""
    index_bits: int | None = None
    """Indices of refraction are rounded to this many bits when they are stored, if to fewer than all else."""
    triangle_test: TriangleTest = "watertight"
    """Which formula decides whether a ray meets a triangle: the truth's own, one of triangle_tests.py, which are
    Embree's, or one of triangle_formulas.py."""
    least_determinant: float = 0.0
    """Of Möller and Trumbore's test of 1997: triangles with a determinant nearer to 0 than this are missed."""
    triangle_points: Literal["along the ray", "barycentric"] = "along the ray"
    """How the point is found where a ray meets a triangle: from its distance, or from its corners with the weights of
    the triangle test (hit_points.py)."""
    sphere_test: Literal[
        "accurate",
        "quadratic",
        "stable quadratic",
        "geometric",
        "from the foot",
        "from the foot, accurate for shadows",
    ] = "accurate"
    """Which formula decides where a ray meets a sphere: the truth's own, one of sphere_formulas.py, or those of
    sphere_tests.py. The last has formulas of float64 for what a ray needs not to know the place of."""
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
    shadow_offset: RayOffset | None = None
    """Of shadow rays alone; None: `ray_offset`, as for the next two."""
    reflected_offset: RayOffset | None = None
    refracted_offset: RayOffset | None = None
    shadow_aim: Literal["light", "parallel", "either"] = "light"
    """Where shadow rays go that start beside the surface: to the light, or in the direction from the surface to it."""
    directions: Literal["as in the truth", "normalised", "unnormalised"] = "as in the truth"
    """Of rays that leave a surface: a mirror's and a refracted one as they come out of their formulas, and a shadow ray
    as long as the way to the light, with least distances as lengths; all made unit vectors once more; or as the first,
    but with least distances compared with t in units of the direction's length."""
    fresnel: Literal["accurate", "as specified", "cosines"] = "accurate"
    """Which formula says how a dielectric splits light: the truth's own, or one of dielectric_formulas.py."""
    refraction: Literal["accurate", "as specified", "heckbert", "bec"] = "accurate"
    """The same of the refracted direction, and of whether there is one."""
    smallest: float = 0.0
    """A colour may be off by so much whatever it is: what is smaller may have been flushed to 0 on the way."""

    def __post_init__(self) -> None:
        if self.image_radius < 0.0:
            raise ValueError("an image radius is not negative")
        if self.triangle_points == "barycentric" and self.triangle_test in {"watertight", "plane and inside"}:
            raise ValueError("points are interpolated with the weights of one of the tests of triangle_tests.py")
        if self.least_determinant < 0.0 or (
            self.least_determinant > 0.0 and self.triangle_test != "moeller-trumbore of 1997"
        ):
            raise ValueError("a least determinant is not negative, and one of Möller and Trumbore's test of 1997")
        if self.sphere_points == "put back" and self.triangle_points != "barycentric":
            raise ValueError("points are put back on spheres by who interpolates those on triangles")
        if self.sphere_test.startswith("from the foot") and (
            self.ray_offset.is_bound or not self.ray_offset.excludes_surface
        ):
            raise ValueError("spheres are tested from the foot by who leaves them as they are, or along their normal")
        if self.smallest < 0.0:
            raise ValueError("what is flushed to zero is not negative")
        of_references = self.sphere_test.startswith("from the foot") or self.shadow_tolerance > 0.0
        if self.needs_policies and (of_references or any(offset.is_bound for offset in self.offsets())):
            raise ValueError(
                "a test from the foot, a shadow tolerance and a bound on an offset do not go with policies apart for "
                "kinds of rays, nor with the formulas of sphere_formulas.py"
            )
        nearest = self.ray_offset.minimum_distance
        if self.shadow_tolerance and (self.ray_offset.excludes_surface or self.shadow_tolerance < nearest):
            raise ValueError("a shadow tolerance is at least the least distance of hits, and excludes no surface")

    def offsets(self) -> tuple[RayOffset, RayOffset, RayOffset, RayOffset]:
        """Of shadow, reflected, refracted and camera rays."""
        own = (self.shadow_offset, self.reflected_offset, self.refracted_offset)
        shadow, reflected, refracted = (self.ray_offset if offset is None else offset for offset in own)
        return shadow, reflected, refracted, self.ray_offset

    @property
    def needs_policies(self) -> bool:
        """Whether ray_policies.py tells what rays do, and not ray_offsets.py."""
        offsets = self.offsets()
        return (
            self.sphere_test in {"quadratic", "stable quadratic", "geometric"}
            or self.triangle_test in {"moeller-trumbore of 1997", "cramer", "plane and inside"}
            or self.directions != "as in the truth"
            or self.shadow_aim != "light"
            or any(offset != offsets[0] or offset.needs_policies for offset in offsets)
        )

    def in_scene(self, scene: Scene) -> ErrorModel:
        """The error model for this scene: lengths grow by the least power of two that makes room for its extent."""
        growth = 1.0
        while extent_of(scene) > self.largest_extent * growth:
            growth *= 2.0
        if growth == 1.0:
            return self
        offset = replace(self.ray_offset, minimum_distance=self.ray_offset.minimum_distance * growth)
        tolerance = self.shadow_tolerance * growth
        return replace(
            self,
            ray_offset=offset,
            shadow_tolerance=tolerance,
            farthest=self.farthest * growth,
            largest_extent=self.largest_extent * growth,
        )

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
        missed = f"with a determinant under {self.least_determinant:.3g} are missed"
        far = f"what is farther than {self.farthest:.4g} in a scene that has them"
        return {
            "summary": self.description,
            "arithmetic": f"one operation errs by at most 2^-{self.precision_bits} of its result",
            "camera rays go": around if self.image_radius > 0.0 else "through the centres of pixels",
            "what counts as centres": self.camera_rays.in_words(),
            "fields of view are": f"{self.field_of_view}, as they are told to it",
            "indices of refraction": f"stored with {self.index_bits or self.precision_bits} bits",
            "triangles": in_code("triangle_test", self.triangle_test),
            "triangles seen edge on": missed if self.least_determinant > 0.0 else "are met as all others",
            "points on triangles": in_code("triangle_points", self.triangle_points),
            "spheres": in_code("sphere_test", self.sphere_test),
            "points on spheres": in_code("sphere_points", self.sphere_points),
            "drawing": self.rasterisation.in_words() if self.rasterisation else "none: rays are traced",
            "rays that leave a surface start": self.ray_offset.in_words(),
            **self._offsets_in_words(),
            "shadow rays go": AIMS[self.shadow_aim],
            "directions": in_code("directions", self.directions),
            "Fresnel's formulas": in_code("fresnel", self.fresnel),
            "refraction": in_code("refraction", self.refraction),
            "shadow rays end": shortened if self.shadow_shortening > 0.0 else "at the light",
            "what is near": f"nearer than {near}" if self.shadow_tolerance > 0.0 else "throws shadows as all else",
            "infinite planes": f"{far} may be met or not" if isfinite(self.farthest) else "are met at any distance",
            "large scenes": grows if isfinite(self.largest_extent) else "as all others",
            "smallest numbers": f"colours may be off by {self.smallest:.3g}" if self.smallest > 0.0 else "are kept",
            "output": self.output.in_words(),
            "random numbers": self.random_choices or "none",
            "departures from the specification": self.departures.in_words(),
        }

    def _offsets_in_words(self) -> dict[str, str]:
        """Of the kinds of rays that may have an offset of their own."""
        of_kinds = {
            "shadow": self.shadow_offset,
            "reflected": self.reflected_offset,
            "refracted": self.refracted_offset,
        }
        return {
            f"{kind} rays start": "as all others" if offset is None else offset.in_words()
            for kind, offset in of_kinds.items()
        }
