"""The file that one starts from: a declaration with each key explained."""

from __future__ import annotations

_TEXT = """# {name} as a renderer of raytruth: raytruth run --renderer-file {file}
# Only name and command are needed. What has a # before it shows what else can be declared, mostly with what holds
# unless it is stated. All keys: raytruth renderers --schema

name = "{name}"

# A list of words; no shell sees them, and a word that names a file is found from this folder. {{scene}} is the file to
# read and {{output}} the picture to write. There are also {{width}}, {{height}}, {{depth}}, {{seed}}, {{samples}},
# {{folder}} (this one) and {{first_hits}}, an OpenEXR file with the channels Z, P.X, P.Y, P.Z, N.X, N.Y, N.Z and id.
command = ["./{name}", "{{scene}}", "{{output}}"]
# Patterns of other files that it consists of: when one changes, it is judged anew. By default, for a script, all files
# with its ending in its folder and below.
# files = ["src/**/*.py", "*.glsl"]
# version = ["./{name}", "--version"]

reads = "json"              # or obj, mitsuba, povray, gltf, pbrt: see raytruth scenes export
writes = "exr"              # or pfm, hdr, ppm, png
# numbers = "half"          # in EXR, if not float; "uint16" in PPM and PNG, if not uint8
colours = "linear"          # or "srgb"
# rounding = "truncated"    # if whole numbers are 255*x cut off, not 255*x + 0.5 cut off
# clipped = true            # if colours above 1 are written as 1 in EXR or PFM
# environment = {{ OMP_NUM_THREADS = "1" }}
# reference = true          # only of an independent reference: what it passes confirms the truth
# family = "{name}"         # of references: those of one family share code, and are one opinion

[limits]                    # for each picture
# seconds = 60
# memory_mib = 4096         # of address space; for Java, Go and JavaScript rather 65536
# output_mib = 256

[scenes]                    # features as raytruth scenes list shows them; their scenes are incomparable, not failed
# refuses = ["absorption", "checkerboard"]

[sampling]                  # only for a program that draws random numbers
# samples = 16              # of each pixel in a picture; the command needs {{seed}} then
# batches = 32              # so many pictures, the mean of which is judged

[arithmetic]
precision = "float64"       # or "float32"
slack_bits = 14             # left for other formulas and another order of operations: of float64's 53 bits 39 are held

[rays]                      # that leave a surface: declare your epsilon here, as it is
# offset = 1e-4             # they start so far beside the surface, in units of the scene
# along = "normal"          # or "ray"
# least_distance = 1e-4     # hits nearer than this are ignored (t_min)
# own_surface = "excluded"  # what a ray leaves is left out of its search; or "tested" as all others are
# shadow_shortening = 0.001 # shadow rays end at this fraction of the way before the light

[formulas]
# In float32 declare what you have typed; raytruth renderers --formulas shows the code of each.
# sphere = "quadratic"              # or "stable quadratic", "geometric"
# sphere_normals = "normalised"     # p - c made a unit vector, not (p - c)/r
# triangle = "moeller-trumbore"     # or "cramer", "plane and inside", "pluecker"; least_determinant is its EPSILON
# fresnel = "as specified"          # the specification's REFR-4 as it is written; or "cosines"
# refraction = "as specified"       # REFR-2 and REFR-3 as they are written; or "heckbert", "bec"

[conventions]               # undone before the picture is judged: none of these is a mistake
# flip_x = true             # the first column is the rightmost
# flip_y = true             # the first row is the lowest
# handedness = "left"       # right is up x forward, so that the picture is mirrored
# pixel = "top left"        # rays go through corners of pixels; also "top right", "bottom left", "bottom right"
# pitch = "size less one"   # the picture's width is divided by W - 1, its height by H - 1
# field_of_view = "horizontal"  # what the scene's angle is taken for; also "larger side", "smaller side"
# depth = 1                 # added to max_depth and {{depth}}: the camera's ray is counted, too
# scale = 255.0             # so many times the radiance is written
# clamped_samples = true    # to 1, before the mean is taken

[model]                     # departures from the specification: `declared`, not passed, where one sees them
# end_of_depth = "background"   # or "local": what a ray brings that the depth leaves no room for
# fresnel = "schlick"       # or "schlick on the incident side"
# constant_weights = [0.1, 0.9] # what glass reflects and transmits at all angles
# With an offset under [rays] there are lit_from and textured_at, each "offset point": from where rays start.
# highlights = "shadowed"   # highlights also in shadows; "everywhere": on sides turned away, too
# clamped_lambert = true    # the sum of all lights' cosines is clamped to 1
"""


def starting_text(name: str) -> str:
    """A TOML file for a program of this name; it loads as it is where there is such a program."""
    return _TEXT.format(name=name, file=f"{name}.toml")
