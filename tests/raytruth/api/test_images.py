from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import raytruth
from raytruth.reference_tracer import rendering
from raytruth.reference_tracer.arithmetics.arithmetic import FLOAT, FLOAT32, FLOAT64
from raytruth.reference_tracer.certified_image import certified_image

if TYPE_CHECKING:
    from raytruth.scenes.scene import Scene

pytestmark = pytest.mark.clause("ARI-1")

# Each with the type of the image's numbers.
ARITHMETICS: dict[Any, Any] = {
    "float": (FLOAT, np.float64),
    "float64": (FLOAT64, np.float64),
    "float32": (FLOAT32, np.float32),
}


@pytest.fixture
def scene() -> Scene:
    """One with few features, which compiles soonest."""
    return raytruth.resized(raytruth.load_scene("ambient-sphere"), 9, 5)


@pytest.mark.parametrize("name", ARITHMETICS)
def test_an_image_is_the_tracers_in_that_arithmetic(name: Any, scene: Scene) -> None:
    arithmetic, numbers = ARITHMETICS[name]
    for samples in (1, 2):
        image = raytruth.render(scene, name, samples)
        assert (image.shape, image.dtype) == ((5, 9, 3), numbers)
        np.testing.assert_array_equal(image, rendering.render(scene, arithmetic, samples=samples).astype(numbers))


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"arithmetic": "half"}, r"^expected an arithmetic of float, float64, float32, found 'half'\.$"),
        ({"samples": 0}, r"^expected 1 to 64 samples, found 0\.$"),
        ({"samples": 65}, r"^expected 1 to 64 samples, found 65\.$"),
    ],
)
def test_an_arithmetic_or_a_number_of_samples_that_there_is_not_is_refused(
    options: dict[str, Any], expected: str, scene: Scene
) -> None:
    with pytest.raises(ValueError, match=expected):
        raytruth.render(scene, **options)


@pytest.mark.clause("ILL-9")
def test_a_light_in_a_seen_point_adds_nothing_there_in_python_floats() -> None:
    scene = raytruth.resized(raytruth.load_scene("single-sphere"), 1, 1)
    hit = raytruth.explain(scene, 0, 0).rays[0].hit
    assert hit is not None
    light = scene.lights[0].model_copy(update={"position": hit.point})
    lit_in_the_light = scene.model_copy(update={"lights": (light,)})
    assert np.isfinite(raytruth.render(lit_in_the_light, "float")).all()


@pytest.mark.clause("ARI-5")
def test_the_truth_is_the_certified_image_and_made_again_only_on_demand(scene: Scene) -> None:
    expected = certified_image(scene)
    told: list[tuple[int, int]] = []
    raytruth.truth(scene, progress=lambda done, total: told.append((done, total)))
    assert told == []
    found = raytruth.truth(scene, fresh=True, progress=lambda done, total: told.append((done, total)))
    np.testing.assert_array_equal(found.middle, expected.middle)
    np.testing.assert_array_equal(found.radius, expected.radius)
    assert found.decided.all()
    assert told == [(1, 1)]


def test_fewer_than_one_job_is_refused(scene: Scene) -> None:
    with pytest.raises(ValueError, match=r"^expected 1 job or more, found 0\.$"):
        raytruth.truth(scene, jobs=0)


@pytest.mark.clause("ARI-7")
def test_the_explanation_of_a_pixel_adds_up_to_the_image(scene: Scene) -> None:
    image = raytruth.render(scene, "float")
    for row, column in np.ndindex(5, 9):
        assert raytruth.explain(scene, column, row).sum == tuple(image[row, column])


@pytest.mark.clause("CMD-2")
def test_a_pixel_outside_the_image_is_refused(scene: Scene) -> None:
    with pytest.raises(raytruth.ExplanationError, match=r"Pixel 9,0 is outside the image .+ to 8,4\.$"):
        raytruth.explain(scene, 9, 0)
