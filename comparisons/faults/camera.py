"""Faults of the camera (docs/spec.md, CAM and IMG)."""

from __future__ import annotations

from raytruth.comparisons.faults.fault import fault
from raytruth.reference_tracer.arithmetics.edits import Edit, after


@fault(
    "CAM-1",
    "primary_ray",
    "Which way does the cross product of forward and up point?",
    after(
        "on_image = along(along(corner, pixel_right, x), pixel_down, y)",
        """
        right = normalize(pixel_right)
        on_image = along(on_image, right, -2.0 * dot(on_image, right))
        """,
    ),
)
def mirrored_image() -> None:
    """Left and right are swapped, because the cross product of forward and up is taken the other way round."""


@fault(
    "CAM-1",
    "camera_frame",
    "Is up perpendicular to the direction of view in every scene?",
    Edit("cross(forward, right)", "negate(normalize(vector_of(scene, CAMERA_UP, 0)))"),
)
def up_not_made_perpendicular() -> None:
    """The camera's own up is taken as it stands, although it is not perpendicular to the direction of view."""


@fault(
    "CAM-1",
    "camera_frame",
    "What does the scene file say that `look_at` is?",
    Edit("subtract(vector_of(scene, CAMERA_LOOK_AT, 0), position)", "vector_of(scene, CAMERA_LOOK_AT, 0)"),
)
def look_at_taken_for_a_direction() -> None:
    """The point to look at is used as the direction of view."""


@fault(
    "CAM-2",
    "primary_ray",
    "Where is the row 0 of the image?",
    after(
        "on_image = along(along(corner, pixel_right, x), pixel_down, y)",
        """
        down = normalize(pixel_down)
        on_image = along(on_image, down, -2.0 * dot(on_image, down))
        """,
    ),
)
def image_upside_down() -> None:
    """Rows are counted from the bottom, so the image stands on its head."""


@fault(
    "CAM-2",
    "camera_frame",
    "How wide is a pixel, and how high, in an image that is not square?",
    Edit("-0.5 * width * pixel", "-0.5 * visible_height"),
    Edit("-0.5 * height * pixel", "-0.5 * visible_height"),
    Edit("scale(right, pixel)", "scale(right, visible_height / width)"),
)
def aspect_ratio_forgotten() -> None:
    """The image is as wide as it is high, whatever its size in pixels: everything is stretched."""


@fault(
    "CAM-2",
    "camera_frame",
    "How many pixels fit between the image's edges, and how many gaps between their centres?",
    Edit("visible_height / height", "visible_height / (height - 1.0)"),
)
def one_pixel_too_few() -> None:
    """The height is divided by the number of rows less one, so that the outermost centres lie on the edges."""


@fault(
    "CAM-3",
    "camera_frame",
    "Between which two edges of the image is the field of view measured?",
    Edit("visible_height / height", "visible_height / width"),
)
def horizontal_field_of_view() -> None:
    """The vertical field of view is taken for the horizontal one."""


@fault(
    "CAM-3",
    "camera_frame",
    "Draw the triangle of camera, image centre and image edge: which angle does it have?",
    Edit("2.0 * tan(visible_height * pi / 360.0)", "tan(visible_height * pi / 180.0)"),
)
def tangent_of_the_whole_angle() -> None:
    """The image's height is taken from the tangent of the whole field of view instead of twice that of its half."""


@fault("CAM-3", "camera_frame", "How many digits does your π have?", Edit("pi", "3.14"))
def short_pi() -> None:
    """π is written as 3.14, so the field of view is a little too narrow."""


@fault(
    "CAM-3",
    "primary_ray",
    "How long is the ray's direction at the image's corner, and who relies on its length?",
    Edit("normalize(on_image)", "on_image"),
)
def camera_rays_not_normalised() -> None:
    """The directions of camera rays are not made unit vectors, which the rest of the code takes them for."""


@fault(
    "CAM-4",
    "primary_ray",
    "From where to where does the view height reach?",
    Edit("add(position, on_image)", "add(position, scale(on_image, 2.0))"),
)
def view_height_from_the_centre() -> None:
    """The view height of a parallel projection is taken for the distance from the centre to the upper edge."""


@fault(
    "CAM-4",
    "primary_ray",
    "What do all rays of a parallel projection have in common?",
    Edit("add(position, on_image), forward", "add(position, on_image), normalize(add(forward, on_image))"),
)
def parallel_rays_spread() -> None:
    """In a parallel projection rays start on the image plane but still run away from the camera's position."""


@fault(
    "CAM-5",
    "radiance_at",
    "What lies between the camera and what it sees first?",
    Edit("integer_of(scene, CAMERA_MEDIUM, 0)", "NOTHING"),
)
def medium_of_the_camera_forgotten() -> None:
    """Camera rays start in empty space although the camera is inside a medium that absorbs."""


@fault(
    "CAM-6",
    "nearest_hit",
    "What does a camera see that stands inside a ball?",
    Edit(
        "nearest, hit = nearest_sphere(scene, origin, direction, left)",
        """
        for sphere in range(rows_of(scene, SPHERE_RADIUS)):
            to_center = subtract(vector_of(scene, SPHERE_CENTER, sphere), origin)
            radius = number_of(scene, SPHERE_RADIUS, sphere)
            inside = left == NOTHING and dot(to_center, to_center) < radius * radius
            distance = distance_to_sphere(scene, origin, direction, left, sphere)
            if distance < nearest and not inside:
                nearest, hit = distance, sphere
        """,
    ),
)
def no_inner_sides_for_the_camera() -> None:
    """Spheres that the camera is inside of are left out, as if they hid nothing."""
