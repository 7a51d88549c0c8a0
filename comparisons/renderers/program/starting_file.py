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
# version = ["./{name}", "--version"]

reads = "json"              # or obj, mitsuba, povray, gltf, pbrt: see raytruth scenes export
writes = "exr"              # or pfm, hdr, ppm, png
# numbers = "half"          # in EXR, if not float; "uint16" in PPM and PNG, if not uint8
colours = "linear"          # or "srgb"
# rounding = "truncated"    # if whole numbers are 255*x cut off, not 255*x + 0.5 cut off
# clipped = true            # if colours above 1 are written as 1 in EXR or PFM
# environment = {{ OMP_NUM_THREADS = "1" }}
# family = "{name}"         # programs of one family share code, and are one opinion

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
# triangle = "moeller-trumbore"     # or "watertight", "pluecker"

[conventions]               # undone before the picture is judged
# flip_x = true
# flip_y = true
"""


def starting_text(name: str) -> str:
    """A TOML file for a program of this name; it loads as it is where there is such a program."""
    return _TEXT.format(name=name, file=f"{name}.toml")
