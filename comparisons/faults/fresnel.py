"""Faults in how a dielectric splits light (docs/spec.md, REFR-4 to REFR-6 and REFR-8)."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit

if TYPE_CHECKING:
    from raytruth.reference_tracer.source.numbers import Scalar, Vector
    from raytruth.reference_tracer.source.scene_data import SceneData


@fault(
    "REFR-4",
    "fresnel_reflectance",
    "Work R out by hand for glass at 60° with Fresnel's equations: how close do you come?",
)
def schlick(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Schlick's approximation (1994) is used in place of Fresnel's equations, with the cosine on the thinner side."""
    normal_incidence = ((ratio - 1.0) / (ratio + 1.0)) * ((ratio - 1.0) / (ratio + 1.0))
    thin = cosine
    if ratio < 1.0:
        thin = g / ratio
    rest = 1.0 - thin
    return normal_incidence + (1.0 - normal_incidence) * rest * rest * rest * rest * rest


@fault("REFR-8", "fresnel_reflectance", "What is R just before the critical angle?")
def schlick_by_the_incident_cosine(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Schlick's approximation takes the cosine of incidence on both sides, so both sides differ along one path."""
    normal_incidence = ((ratio - 1.0) / (ratio + 1.0)) * ((ratio - 1.0) / (ratio + 1.0))
    rest = 1.0 - cosine
    return normal_incidence + (1.0 - normal_incidence) * rest * rest * rest * rest * rest


@fault("REFR-4", "fresnel_reflectance", "Does glass reflect the same at every angle?")
def reflectance_of_normal_incidence(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The reflectance at normal incidence is used for all angles."""
    return ((ratio - 1.0) / (ratio + 1.0)) * ((ratio - 1.0) / (ratio + 1.0))


@fault("REFR-4", "fresnel_reflectance", "How many polarisations has light?")
def one_polarisation_only(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Only the polarisation across the plane of incidence is taken."""
    amplitude = (cosine - g) / (cosine + g)
    return amplitude * amplitude


@fault("REFR-4", "fresnel_reflectance", "What adds up: amplitudes or intensities?")
def amplitudes_averaged(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Both amplitudes are averaged and then squared, instead of the other way round."""
    across = (cosine - g) / (cosine + g)
    within = (ratio * ratio * cosine - g) / (ratio * ratio * cosine + g)
    mean = 0.5 * (abs(across) + abs(within))
    return mean * mean


@fault("REFR-4", "fresnel_reflectance", "What happens at the rim of a glass ball?")
def wrong_at_grazing_angles_only(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The reflectance is right up to a cosine of 0.2 and stays there for all flatter rays."""
    steep = max(cosine, 0.2)
    cosine_beyond = sqrt(g * g + steep * steep - cosine * cosine)
    across = (steep - cosine_beyond) / (steep + cosine_beyond)
    within = (ratio * ratio * steep - cosine_beyond) / (ratio * ratio * steep + cosine_beyond)
    return 0.5 * (across * across + within * within)


@fault(
    "REFR-4",
    "fresnel_reflectance",
    "Work R out by hand for a look straight onto the glass: does your program give the same?",
)
def reflectance_one_percent_off(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """The reflectance is one percent too low."""
    across = (cosine - g) / (cosine + g)
    within = (ratio * ratio * cosine - g) / (ratio * ratio * cosine + g)
    return 0.495 * (across * across + within * within)


@fault("REFR-8", "fresnel_reflectance", "How much does a surface reflect between two equal media?")
def always_four_percent(cosine: Scalar, g: Scalar, ratio: Scalar) -> Scalar:
    """Every dielectric reflects at least the four percent of window glass, however small the step of the index."""
    across = (cosine - g) / (cosine + g)
    within = (ratio * ratio * cosine - g) / (ratio * ratio * cosine + g)
    return max(0.04, 0.5 * (across * across + within * within))


@fault(
    "REFR-5",
    "split",
    "How does radiance change where light is squeezed into a narrower cone?",
    Edit("RADIOMETRIC", "False"),
)
def radiance_not_scaled() -> None:
    """The transmitted radiance is not divided by the square of the index ratio."""


@fault(
    "REFR-5",
    "split",
    "In which direction do you follow the light: from the camera or from the lamp?",
    Edit("transmitted / (ratio * ratio)", "transmitted * (ratio * ratio)"),
)
def radiance_scaled_the_wrong_way() -> None:
    """The transmitted radiance is multiplied by the square of the index ratio instead of divided by it."""


@fault("REFR-5", "split", "In which of the two conventions does radiance scale?", Edit("RADIOMETRIC", "True"))
def radiance_scaled_in_the_classical_equation() -> None:
    """The transmitted light is divided by the square of the index ratio in the classical convention, too."""


@fault("REFR-5", "split", "What do the reflected and the transmitted part add up to?", Edit("1.0 - reflected", "1.0"))
def all_of_it_transmitted() -> None:
    """What is reflected is not taken away from what is transmitted."""


@fault("REFR-5", "total_reflection_weight", "Where does the light go that cannot get out of the glass?")
def total_reflection_is_black(scene: SceneData, material: int) -> Vector:
    """Rays that are totally reflected end there and bring nothing."""
    return (0.0, 0.0, 0.0)


@fault(
    "REFR-6",
    "split",
    "Which material states its own constants, and where do you use them?",
    Edit("CONSTANT_SPLIT", "False"),
)
def constants_ignored() -> None:
    """Fresnel's equations are used for materials that state the classical constants."""


@fault(
    "REFR-6",
    "total_reflection_weight",
    "How much does glass with constants reflect beyond the critical angle?",
    Edit("CONSTANT_SPLIT", "False"),
)
def total_reflection_in_full() -> None:
    """Beyond the critical angle everything is reflected, also where the material states a reflectance."""
