"""The child process of the Cycles adapter: reads `job.json` in the current folder and writes `result.npz` there.

Run as `python -P -m raytruth.comparisons.renderers.cycles.worker`. It alone imports Blender, which may end
its process. Of each part of the light it leaves a file that Blender opens.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from raytruth.comparisons.processes.worker_results import write_arrays
from raytruth.comparisons.renderers.cycles.job import JOB_FILE, RESULT_FILE, Ball, Camera, Job, Lamp, Mesh, Part
from raytruth.comparisons.renderers.cycles.nodes import add_material, add_world

Array = NDArray[Any]
BlenderScene = Any  # Blender's types are made when it runs

PICTURE_FILE = "picture.exr"
# The first sample of a pixel goes through its centre, whatever the filter (integrate_camera_sample in
# src/kernel/integrator/init_from_camera.h); so each image has one, and samples differ by the seed.
SAMPLES = 1
# No rays go on at random for lack of light: up to so many bounces, the most that Blender's settings take.
MOST_BOUNCES = 1024
# The height of the sensor is arbitrary, since only its quotient by twice the focal length counts. With this one the
# focal length keeps above 1, the least in Blender, for all angles up to 177.7 degrees.
SENSOR_HEIGHT = 100.0


def main() -> None:
    """Do the job in the current folder."""
    job = Job.model_validate_json(Path(JOB_FILE).read_bytes())
    images = np.zeros((max(1, job.batches), job.camera.height, job.camera.width, 3))
    seconds = 0.0
    for part in job.parts:
        scene = build(job, part)
        bpy.ops.wm.save_as_mainfile(filepath=str(Path(f"{part.name}.blend").resolve()), compress=True)
        start = time.perf_counter()
        images += render_batches(scene, job)
        seconds += time.perf_counter() - start
    result = {"image": images.mean(axis=0).astype(np.float32)}
    if job.batches:
        result["batch_means"] = images.astype(np.float32)
    result["seconds"] = np.array(seconds)
    result["version"] = np.array(bpy.app.version_string)
    Path(PICTURE_FILE).unlink()
    write_arrays(Path(RESULT_FILE), result)


def render_batches(scene: BlenderScene, job: Job) -> Array:
    """Means of batches in float64, of shape (batches, height, width, 3); each image has a seed of its own."""
    camera = job.camera
    means = np.zeros((max(1, job.batches), camera.height, camera.width, 3))
    samples = job.batch_samples if job.batches else 1
    # A pixel's numbers follow from its hash and the seed, combined by exclusive or (path_rng_pixel_init in
    # src/kernel/sample/pattern.h): seeds in a row would give one pixel the numbers that others had. These are spread
    # over all that Blender takes.
    seeds = np.random.default_rng(1980).integers(0, 2**31, size=(len(means), samples))
    for batch, of_batch in enumerate(seeds.tolist()):
        for seed in of_batch:
            scene.cycles.seed = seed
            means[batch] += render_image(scene)
    return means / samples


def render_image(scene: BlenderScene) -> Array:
    """Linear RGB in float32, row 0 on top."""
    scene.render.filepath = str(Path(PICTURE_FILE).resolve())
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    width, height = picture.size
    pixels = np.empty(width * height * picture.channels, dtype=np.float32)
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    image: Array = pixels.reshape(height, width, -1)[::-1, :, :3]
    return image


def build(job: Job, part: Part) -> BlenderScene:
    """A new scene of Blender, in place of the one before."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    set_sampling(scene, part.bounces)
    set_output(scene, job.camera)
    add_camera(scene, job.camera)
    add_world(scene, part.background)
    materials = [add_material(number, closures) for number, closures in enumerate(part.materials)]
    for shape in job.objects:
        item = add_object(scene, new_mesh(shape)) if isinstance(shape, Mesh) else add_ball(scene, shape)
        item.data.materials.append(materials[shape.material])
    for lamp in part.lamps:
        add_lamp(scene, lamp)
    return scene


def set_sampling(scene: BlenderScene, bounces: int) -> None:
    """One sample, nothing clamped, blurred or left out, and no diffuse reflection of what is reflected diffusely."""
    preferences = bpy.context.preferences
    preferences.view.show_developer_ui = preferences.experimental.use_cycles_debug = True  # to set the pattern
    cycles = scene.cycles
    # Each pixel has a sequence of its own: blue noise would make neighbours depend on one another. Of the other
    # pattern that has one, Sobol-Burley, a single sample will not do: the first bit of each of its numbers is then the
    # seed's last bit, or its opposite (reversed_bit_owen of 0 in src/kernel/sample/util.h), so that the choices of one
    # path depend on one another. Seen through many bounces in glass, pixels were up to 0.2 too bright or too dark.
    cycles.sampling_pattern = "TABULATED_SOBOL"
    cycles.samples = SAMPLES
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_guiding = cycles.use_fast_gi = False
    cycles.use_light_tree = cycles.auto_scrambling_distance = False
    cycles.pixel_filter_type, cycles.filter_width = "GAUSSIAN", 0.01  # the least; a box would be one pixel wide
    cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = bounces
    cycles.diffuse_bounces = 0
    cycles.min_light_bounces = MOST_BOUNCES
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0.0
    cycles.blur_glossy = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True


def set_output(scene: BlenderScene, camera: Camera) -> None:
    """Have images written in linear float32, as they are computed."""
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = camera.width, camera.height, 100
    render.use_persistent_data = True  # else each seed would build the scene anew
    render.film_transparent = False
    scene.view_settings.view_transform = "Raw"
    settings = render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    settings.exr_codec = "NONE"


def add_object(scene: BlenderScene, data: Any) -> Any:
    """Put data (a mesh, a lamp, points) into the scene as an object at the origin."""
    item = bpy.data.objects.new("object", data)
    scene.collection.objects.link(item)
    return item


def place(item: Any, axes: tuple[Any, Any, Any], position: Any) -> None:
    """Give an object these axes, which Blender would store as angles if they were its own: so they are its parent's."""
    matrix = [[axis[row] for axis in axes] + [position[row]] for row in range(3)]
    item.parent = bpy.data.objects.new("frame", None)
    item.matrix_parent_inverse = Matrix([*matrix, [0.0, 0.0, 0.0, 1.0]])


def add_camera(scene: BlenderScene, camera: Camera) -> None:
    """The camera, whose rays start as near to it as Blender allows."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    if camera.tangent is None:
        data.type, data.ortho_scale = "ORTHO", camera.view_height
    else:
        data.sensor_height, data.lens = SENSOR_HEIGHT, SENSOR_HEIGHT / 2 / camera.tangent
    data.clip_start, data.clip_end = 1e-6, camera.far
    scene.camera = add_object(scene, data)
    place(scene.camera, camera.axes, camera.position)
    scene.collection.objects.link(scene.camera.parent)


def new_mesh(shape: Mesh) -> Any:
    """Flat triangles, in their order."""
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(shape.vertices, [], shape.faces, shade_flat=True)
    return mesh


def add_ball(scene: BlenderScene, shape: Ball) -> Any:
    """A cloud of one point, which Blender makes of a mesh of one corner, and its radius."""
    mesh = bpy.data.meshes.new("ball")
    mesh.from_pydata([shape.center], [], [])
    item = add_object(scene, mesh)
    item.select_set(True)
    bpy.context.view_layer.objects.active = item
    bpy.ops.object.convert(target="POINTCLOUD")
    item.select_set(False)
    item.data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", (shape.radius,))
    return item


def add_lamp(scene: BlenderScene, lamp: Lamp) -> None:
    """A point or a sun, without extent."""
    light = bpy.data.lights.new("lamp", lamp.kind)
    brightest = max(lamp.strength)
    light.color = [channel / brightest if brightest else 0.0 for channel in lamp.strength]
    item = add_object(scene, light)
    if lamp.kind == "POINT":
        light.shadow_soft_size = 0.0
        light.energy = 4 * np.pi * brightest  # the power of a source of that intensity in all directions
        item.location = lamp.vector
    else:
        light.angle = 0.0
        light.energy = brightest
        backward = np.negative(lamp.vector)
        across = np.cross(backward, np.eye(3)[np.abs(backward).argmin()])
        across /= np.linalg.norm(across)
        place(item, (across, np.cross(backward, across), backward), (0.0, 0.0, 0.0))
        scene.collection.objects.link(item.parent)


if __name__ == "__main__":
    main()
