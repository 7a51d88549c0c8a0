"""What a scene may require; the source says `if MIRRORS:`, and an instantiation keeps only what its scene requires.

The names are those of `raytruth.scenes.features.Feature`. Everything is on in the plain source, so that it can be read,
imported and type-checked as it is.
"""

PERSPECTIVE: bool = True
SPHERES: bool = True
TRIANGLES: bool = True
BOUNDING_VOLUMES: bool = True
PLANES: bool = True
BACKGROUND: bool = True
BACKGROUND_GRADIENT: bool = True
CHECKERBOARD: bool = True
EMISSION: bool = True
AMBIENT: bool = True
DIFFUSE: bool = True
PHONG: bool = True
BLINN: bool = True
POINT_LIGHTS: bool = True
DIRECTIONAL_LIGHTS: bool = True
INVERSE_SQUARE_FALLOFF: bool = True
POLYNOMIAL_FALLOFF: bool = True
MIRRORS: bool = True
DIELECTRICS: bool = True
CONSTANT_SPLIT: bool = True
ABSORPTION: bool = True
RADIOMETRIC: bool = True
