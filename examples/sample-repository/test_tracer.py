"""Tests of single functions; those of whole pictures are added by raytruth's plugin (pytest.ini)."""

import math

from tracer import Sphere, Tracer, Triangle


def test_a_ray_meets_the_near_side_of_a_sphere():
    sphere = Sphere((0, 0, 0), 1, {})
    assert sphere.distance((0, 0, 5), (0, 0, -1), False) == 4


def test_a_ray_that_leaves_a_sphere_outwards_does_not_meet_it_again():
    sphere = Sphere((0, 0, 0), 1, {})
    assert sphere.distance((0, 0, 1), (0, 0, 1), True) == math.inf


def test_edges_belong_to_a_triangle():
    triangle = Triangle([(0, 0, 0), (1, 0, 0), (0, 1, 0)], {})
    assert triangle.distance((0.5, 0, 1), (0, 0, -1), False) == 1


def test_what_meets_nothing_brings_the_background():
    scene = {"objects": [], "materials": {}, "background": {"color": [1, 2, 3]}}
    assert Tracer(scene).background((0, 0, -1)) == [1, 2, 3]
