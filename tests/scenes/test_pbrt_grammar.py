"""The reader of pbrt files reads what pbrt reads, and refuses what pbrt refuses."""

from __future__ import annotations

import pytest

from tests.scenes.pbrt_grammar import GrammarError, parse

pytestmark = pytest.mark.clause("REN-2")

WORLD = "WorldBegin\n"
# As people write them: values without brackets, whole numbers for floats, comments behind, several on a line.
GOOD = [
    'LookAt 3 4 1.5   # eye\n .5 .5 0 # at\n 0 0 1\nCamera "perspective" "float fov" 45\n' + WORLD,
    'Sampler "zsobol" "integer pixelsamples" [128] Integrator "path"\nWorldBegin',
    'Film "rgb" "string filename" "simple.png" "integer xresolution" [ 400 ] "integer yresolution" [400]\n' + WORLD,
    WORLD + 'LightSource "infinite" "rgb L" [ .4 .45 .5 ]',
    WORLD + 'LightSource "distant" "point3 from" [ -30 40 100 ]\n  "float scale" 1.5e0',
    WORLD + 'AttributeBegin\n MakeNamedMaterial "g" "string type" "dielectric" "float eta" 1.5\n'
    ' NamedMaterial "g" Shape "sphere" "float radius" 1\nAttributeEnd',
    WORLD + 'Texture "checks" "spectrum" "checkerboard"\n "rgb tex1" [.1 .1 .1] "rgb tex2" [.8 .8 .8]\n'
    'MakeNamedMaterial "m" "string type" "diffuse" "texture reflectance" "checks"',
    WORLD + 'Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]#end',
    'Option "disablepixeljitter" true\nScale -1 1 1\nWorldBegin',
]
BAD = {
    "": "no WorldBegin",
    'Camera "perspective\n"' + WORLD: "unterminated string",
    "Camera perspective\n" + WORLD: "quoted string",
    "Kamera\n" + WORLD: "unknown directive",
    'WorldEnd "x"': "unknown directive",
    "LookAt 0 0 1  0 0 0  0 1": "premature end",
    "LookAt 0 0 1  0 0 0  0 1 up\n" + WORLD: "expected a number",
    "Scale 1,5 1 1\n" + WORLD: "expected a number",
    "Scale [ 1 1 1 ]\n" + WORLD: "expected a number",
    'Camera "perspective" "fov" 45\n' + WORLD: "type and the name",
    'Camera "perspective" "double fov" 45\n' + WORLD: "type and the name",
    'Camera "perspective" "float fov" "45"\n' + WORLD: "expected a number",
    'Camera "perspective" "float fov" [45\n' + WORLD: "premature end",
    'Camera "perspective" "float fov" []\n' + WORLD: "0 values",
    'Camera "perspective" "float fov" [45 46]\n' + WORLD: "2 values",
    'Camera "perspective" "float view" 45\n' + WORLD: "no parameters",
    'Camera "perspective" "float fov" 45 "float fov" 46\n' + WORLD: "twice",
    'Camera "fisheye"\n' + WORLD: "no parameters",
    'Integrator "path" "integer maxdepth" 1.5\n' + WORLD: "32-bit integer",
    'Integrator "path" "integer maxdepth" 3000000000\n' + WORLD: "32-bit integer",
    'Film "rgb" "bool savefp16" "false"\n' + WORLD: "true or false",
    'Option "bool disablepixeljitter" true\n' + WORLD: "option",
    'Option "disablepixeljitter" 1\n' + WORLD: "option",
    'LightSource "point"\n' + WORLD: "wrong side",
    WORLD + 'Film "rgb"': "wrong side",
    WORLD + WORLD: "twice",
    WORLD + "AttributeBegin": "without an end",
    WORLD + "AttributeEnd": "without AttributeBegin",
    WORLD + 'LightSource "point" "rgb I" [1 2]': "2 values",
    WORLD + 'MakeNamedMaterial "m" "rgb reflectance" [1 1 1]': "missing",
    WORLD + 'Texture "t" "checkerboard"': "premature end",
}


@pytest.mark.parametrize("text", GOOD)
def test_what_pbrt_reads_is_read(text: str) -> None:
    assert "WorldBegin" in [directive.name for directive in parse(text)]


@pytest.mark.parametrize("text", BAD)
def test_what_pbrt_does_not_read_is_refused(text: str) -> None:
    with pytest.raises(GrammarError, match=BAD[text]):
        parse(text)


def test_words_numbers_and_values_are_found() -> None:
    look, camera, _, light = parse(
        'LookAt 1 2 3 4 5 6 7 8 9 Camera "perspective" "float screenwindow" [ -1 1 -.5 5e-1 ] WorldBegin '
        'LightSource "point" "rgb I" [ 1 2 3 ]'
    )
    assert look.numbers == [1, 2, 3, 4, 5, 6, 7, 8, 9]
    assert camera.words == ["perspective"]
    assert camera.parameters == {"float screenwindow": [-1.0, 1.0, -0.5, 0.5]}
    assert light.parameters == {"rgb I": [1.0, 2.0, 3.0]}
