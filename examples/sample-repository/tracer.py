#!/usr/bin/env python3
"""A small ray tracer: spheres, triangles and planes that are diffuse, glow or mirror, with hard shadows.

It reads a scene file of raytruth and writes a PFM picture: tracer.py SCENE OUTPUT
"""

import json
import math
import struct
import sys
from pathlib import Path

BLACK = (0.0, 0.0, 0.0)


def dot(a, b):
    """The scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    """The vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def along(origin, t, direction):
    """The point origin + t·direction."""
    return tuple(o + t * d for o, d in zip(origin, direction, strict=True))


def minus(a, b):
    """The vector from b to a."""
    return along(a, -1.0, b)


def unit(a):
    """The unit vector in the direction of a."""
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


class Sphere:
    """A sphere with its material."""

    def __init__(self, centre, radius, material):
        """Keep what it is made of."""
        self.centre, self.radius, self.material = centre, radius, material

    def distance(self, origin, direction, is_left):
        """The smallest t > 0 at which the ray meets it, in lengths of its direction; infinity where it does not."""
        to_origin = minus(origin, self.centre)
        a, b = dot(direction, direction), dot(direction, to_origin)
        if is_left:  # the ray starts on it: there is one other root
            roots = (-2 * b / a,)
        else:
            foot = along(to_origin, -b / a, direction)
            left = self.radius**2 - dot(foot, foot)
            if left < 0:
                return math.inf
            half = math.sqrt(left / a)
            roots = (-b / a - half, -b / a + half)
        return min((t for t in roots if t > 0), default=math.inf)

    def normal(self, point):
        """The outward unit normal."""
        return unit(minus(point, self.centre))


class Triangle:
    """A triangle with its material."""

    def __init__(self, corners, material):
        """Keep a corner and the two edges from it."""
        self.corner, self.material = corners[0], material
        self.edges = [minus(corner, corners[0]) for corner in corners[1:]]

    def distance(self, origin, direction, is_left):
        """As that of a sphere, by Möller and Trumbore (1997)."""
        first, second = self.edges
        p = cross(direction, second)
        determinant = dot(first, p)
        if is_left or determinant == 0:
            return math.inf
        s = minus(origin, self.corner)
        q = cross(s, first)
        u, v, t = dot(s, p) / determinant, dot(direction, q) / determinant, dot(second, q) / determinant
        return t if u >= 0 and v >= 0 and u + v <= 1 and t > 0 else math.inf

    def normal(self, _):
        """The unit normal of the side from which its corners run counterclockwise."""
        return unit(cross(*self.edges))


class Plane:
    """An infinite plane with its material."""

    def __init__(self, point, normal, material):
        """Keep what it is made of."""
        self.point, self.facing, self.material = point, unit(normal), material

    def distance(self, origin, direction, is_left):
        """As that of a sphere."""
        height, approach = dot(minus(self.point, origin), self.facing), dot(direction, self.facing)
        return height / approach if not is_left and height * approach > 0 else math.inf

    def normal(self, _):
        """The unit normal as the scene states it."""
        return self.facing


class Tracer:
    """A scene that is ready to be rendered."""

    def __init__(self, scene):
        """Take the scene as its file has it."""
        self.scene = scene
        spheres, triangles, planes = [], [], []
        for shape in scene["objects"]:
            material = scene["materials"][shape["material"]]
            if shape["shape"] == "sphere":
                spheres.append(Sphere(shape["center"], shape["radius"], material))
            elif shape["shape"] == "triangle":
                triangles.append(Triangle(shape["vertices"], material))
            elif shape["shape"] == "plane":
                planes.append(Plane(shape["point"], shape["normal"], material))
            else:
                corners = shape["vertices"]
                triangles += [Triangle([corners[i] for i in face], material) for face in shape["faces"]]
        self.primitives = spheres + triangles + planes

    def is_hidden(self, point, direction, farthest, left):
        """Whether anything is met before `farthest`, in lengths of the direction."""
        return any(it.distance(point, direction, it is left) < farthest for it in self.primitives)

    def lights(self, point, left):
        """The direction to each light that is seen from the point, and what a surface facing it receives."""
        for light in self.scene.get("lights", []):
            if light["kind"] == "directional":
                to_light, strength = tuple(-x for x in light["direction"]), light["irradiance"]
                farthest = math.inf
            else:
                to_light, strength, farthest = minus(light["position"], point), light["intensity"], 1.0
                if light["falloff"] == "inverse_square":
                    strength = [x / dot(to_light, to_light) for x in strength]
            if not self.is_hidden(point, to_light, farthest, left):
                yield unit(to_light), strength

    def background(self, direction):
        """What a ray brings that meets nothing."""
        background = self.scene.get("background") or {"color": BLACK}
        if "color" in background:
            return background["color"]
        k = (unit(direction)[1] + 1) / 2
        return [(1 - k) * low + k * high for low, high in zip(background["bottom"], background["top"], strict=True)]

    def radiance(self, origin, direction, depth, left=None):
        """What the ray brings back; `left` is the primitive that it starts on."""
        t, hit = min(((it.distance(origin, direction, it is left), it) for it in self.primitives), key=lambda it: it[0])
        if t == math.inf:
            return self.background(direction)
        point, normal, material = along(origin, t, direction), hit.normal(along(origin, t, direction)), hit.material
        if dot(direction, normal) >= 0:
            normal = tuple(-x for x in normal)
        colour = list((material.get("emission") or {"radiance": BLACK})["radiance"])
        if ambient := material.get("ambient"):
            colour = [
                c + k * i for c, k, i in zip(colour, ambient["reflectance"], self.scene["ambient_light"], strict=True)
            ]
        if diffuse := material.get("diffuse"):
            scale = math.pi if self.scene["convention"] == "radiometric" else 1.0
            for to_light, strength in self.lights(point, hit):
                cosine = max(dot(normal, to_light), 0.0) / scale
                terms = zip(colour, diffuse["reflectance"], strength, strict=True)
                colour = [c + k * e * cosine for c, k, e in terms]
        if depth > 0 and (mirror := material.get("mirror")):
            reflected = along(direction, -2 * dot(direction, normal), normal)
            brought = self.radiance(point, reflected, depth - 1, hit)
            colour = [c + k * r for c, k, r in zip(colour, mirror["reflectance"], brought, strict=True)]
        return colour

    def picture(self):
        """The rows of the picture, the highest first."""
        camera, depth = self.scene["camera"], self.scene.get("max_depth", 0)
        width, height, eye = camera["width"], camera["height"], camera["position"]
        forward = unit(minus(camera["look_at"], eye))
        right = unit(cross(forward, camera.get("up", (0, 1, 0))))
        down = cross(forward, right)
        is_perspective = camera["projection"] == "perspective"
        view = (
            2 * math.tan(math.radians(camera["vertical_field_of_view"]) / 2)
            if is_perspective
            else camera["view_height"]
        )
        for row in range(height):
            for column in range(width):
                x, y = ((column + 0.5 - width / 2) * view / height, (row + 0.5 - height / 2) * view / height)
                beside = along(along(BLACK, x, right), y, down)
                if is_perspective:
                    yield self.radiance(eye, unit(along(forward, 1.0, beside)), depth)
                else:
                    yield self.radiance(along(eye, 1.0, beside), forward, depth)


def main(scene_file, output):
    """Render a scene file to a PFM file, whose lowest row comes first."""
    scene = json.loads(Path(scene_file).read_text(encoding="utf-8"))
    width, height = scene["camera"]["width"], scene["camera"]["height"]
    pixels = list(Tracer(scene).picture())
    rows = [pixels[start : start + width] for start in range(0, width * height, width)]
    numbers = [number for row in reversed(rows) for pixel in row for number in pixel]
    header = f"PF\n{width} {height}\n-1.0\n".encode("ascii")
    Path(output).write_bytes(header + struct.pack(f"<{len(numbers)}f", *numbers))


if __name__ == "__main__":
    main(*sys.argv[1:])
