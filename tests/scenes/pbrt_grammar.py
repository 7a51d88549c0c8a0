"""A strict reader of pbrt-v4's scene files, by the rules of its parser.

After src/pbrt/parser.cpp (Tokenizer::Next, parseParameters, parse), paramdict.cpp (how many values a type has) and
scene.cpp (what may stand before WorldBegin, what after it). Parameters are those that each implementation looks up,
since pbrt ends at any other ("ReportUnused"). Only what is exported is known here, so that this refuses more than pbrt.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field


class GrammarError(Exception):
    """What pbrt would not read."""


@dataclass
class Directive:
    """A directive with its words and numbers, and the values of its parameters by name."""

    name: str
    words: list[str] = field(default_factory=list)
    numbers: list[float] = field(default_factory=list)
    parameters: dict[str, list[float] | list[str] | list[bool]] = field(default_factory=dict)


# How many words and how many numbers a directive has, and whether parameters follow.
SHAPES = {
    "Option": (1, 0, False),
    "Scale": (0, 3, False),
    "Translate": (0, 3, False),
    "LookAt": (0, 9, False),
    "NamedMaterial": (1, 0, False),
    "WorldBegin": (0, 0, False),
    "AttributeBegin": (0, 0, False),
    "AttributeEnd": (0, 0, False),
    "Texture": (3, 0, True),
    **dict.fromkeys(
        (
            "AreaLightSource",
            "Camera",
            "Film",
            "Integrator",
            "LightSource",
            "MakeNamedMaterial",
            "PixelFilter",
            "Sampler",
            "Shape",
        ),
        (1, 0, True),
    ),
}
BEFORE_THE_WORLD = {"Option", "Camera", "Film", "Integrator", "PixelFilter", "Sampler"}
ANYWHERE = {"Scale", "Translate", "LookAt", "WorldBegin"}
OPTIONS = {"disablepixeljitter", "disabletexturefiltering", "disablewavelengthjitter"}
# How many values of each type make one.
WIDTHS = {"bool": 1, "float": 1, "integer": 1, "string": 1, "texture": 1, "point3": 3, "vector3": 3, "rgb": 3}
# Of each implementation, by directive and name.
PARAMETERS = {
    "Integrator path": {"integer maxdepth", "string lightsampler", "bool regularize"},
    "Sampler zsobol": {"integer pixelsamples", "integer seed", "string randomization"},
    "PixelFilter box": {"float xradius", "float yradius"},
    "Film rgb": {
        "string filename",
        "integer xresolution",
        "integer yresolution",
        "bool savefp16",
        "float iso",
        "string sensor",
        "float maxcomponentvalue",
    },
    "Camera perspective": {"float fov", "float screenwindow", "float lensradius", "float focaldistance"},
    "Camera orthographic": {"float screenwindow", "float lensradius", "float focaldistance"},
    "LightSource point": {"rgb I", "float scale", "float power", "point3 from"},
    "LightSource distant": {"rgb L", "float scale", "float illuminance", "point3 from", "point3 to"},
    "LightSource infinite": {"rgb L", "float scale", "float illuminance"},
    "AreaLightSource diffuse": {"rgb L", "float scale", "float power", "bool twosided"},
    "Shape sphere": {"float radius", "float zmin", "float zmax", "float phimax"},
    "Shape trianglemesh": {"point3 P", "integer indices"},
    "material diffuse": {"string type", "rgb reflectance", "texture reflectance"},
    "material dielectric": {"string type", "float eta", "float roughness"},
    "Texture checkerboard": {
        "rgb tex1",
        "rgb tex2",
        "integer dimension",
        "string mapping",
        "vector3 v1",
        "vector3 v2",
        "float udelta",
        "float vdelta",
    },
}
# Lists may hold several values of these; of all others there is one.
LISTS = {"float screenwindow", "point3 P", "integer indices"}

# A string on one line, a bracket, a comment up to the end of its line, or anything up to a space, quote or bracket.
TOKEN = re.compile(r'"(?:[^"\\\n]|\\.)*"|[\[\]]|#[^\n\r]*|[^\s"\[\]#][^ \n\t\r"\[\]]*')
INTEGER = re.compile(r"[-+]?\d+", re.ASCII)
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
LARGEST_INTEGER = 2**31 - 1


def parse(text: str) -> list[Directive]:
    """The directives of a scene file in order. Raises GrammarError."""
    waiting = _tokens(text)[::-1]
    directives = []
    while waiting:
        name = waiting.pop()
        if name not in SHAPES:
            raise GrammarError(f"unknown directive {name}")
        words, numbers, has_parameters = SHAPES[name]
        directive = Directive(name, [_string(_next(waiting)) for _ in range(words)])
        directive.numbers = [_number(_next(waiting)) for _ in range(numbers)]
        if name == "Option" and (directive.words[0] not in OPTIONS or _next(waiting) not in {"true", "false"}):
            raise GrammarError(f"option {directive.words[0]}")
        while has_parameters and waiting and waiting[-1].startswith('"'):
            _add_parameter(directive, waiting)
        directives.append(directive)
    _check_blocks(directives)
    for directive in directives:
        _check_parameters(directive)
    return directives


def _tokens(text: str) -> list[str]:
    found, position = [], 0
    while position < len(text):
        if text[position] in " \n\t\r":
            position += 1
            continue
        match = TOKEN.match(text, position)
        if match is None:
            raise GrammarError(f"unterminated string: {text[position : position + 20]!r}")
        found.append(match[0])
        position = match.end()
    return [token for token in found if not token.startswith("#")]


def _next(waiting: list[str]) -> str:
    if not waiting:
        raise GrammarError("premature end of file")
    return waiting.pop()


def _string(token: str) -> str:
    if not token.startswith('"'):
        raise GrammarError(f"expected a quoted string, found {token}")
    if "\\" in token:
        raise GrammarError("escapes are not exported")
    return token[1:-1]


def _number(token: str) -> float:
    if not NUMBER.fullmatch(token):
        raise GrammarError(f"expected a number, found {token}")
    return float(token)


def _integer(token: str) -> float:
    if not INTEGER.fullmatch(token) or abs(int(token)) > LARGEST_INTEGER:
        raise GrammarError(f"expected a 32-bit integer, found {token}")
    return int(token)


def _boolean(token: str) -> bool:
    if token not in {"true", "false"}:
        raise GrammarError(f"expected true or false, found {token}")
    return token == "true"


READERS = {"integer": _integer, "bool": _boolean, "string": _string, "texture": _string}


def _add_parameter(directive: Directive, waiting: list[str]) -> None:
    declaration = _string(waiting.pop()).split()
    if len(declaration) != 2 or declaration[0] not in WIDTHS:
        raise GrammarError(f"expected the type and the name of a parameter, found {declaration}")
    values = [_next(waiting)]
    if values == ["["]:
        while values[-1] != "]":
            values.append(_next(waiting))
        values = values[1:-1]
    kind, key = declaration[0], " ".join(declaration)
    read = READERS.get(kind, _number)
    found = [read(value) for value in values]
    if not found or len(found) % WIDTHS[kind] or (len(found) > WIDTHS[kind] and key not in LISTS):
        raise GrammarError(f"{key} has {len(found)} values")
    if key in directive.parameters:
        raise GrammarError(f"{key} is stated twice")
    directive.parameters[key] = found  # type: ignore[assignment]  # all of one type: one reader read them


def _check_blocks(directives: list[Directive]) -> None:
    depth, in_world = 0, False
    for directive in directives:
        if directive.name == "WorldBegin" and in_world:
            raise GrammarError("WorldBegin twice")
        if directive.name not in ANYWHERE and (directive.name in BEFORE_THE_WORLD) == in_world:
            raise GrammarError(f"{directive.name} on the wrong side of WorldBegin")
        in_world = in_world or directive.name == "WorldBegin"
        depth += {"AttributeBegin": 1, "AttributeEnd": -1}.get(directive.name, 0)
        if depth < 0:
            raise GrammarError("AttributeEnd without AttributeBegin")
    if depth or not in_world:
        raise GrammarError("a block without an end, or no WorldBegin")


def _check_parameters(directive: Directive) -> None:
    if not SHAPES[directive.name][2]:
        return
    kind = f"{directive.name} {directive.words[-1]}"
    if directive.name == "MakeNamedMaterial":
        kind = f"material {directive.parameters.get('string type', ['missing'])[0]}"
    unknown = directive.parameters.keys() - PARAMETERS.get(kind, set())
    if kind not in PARAMETERS or unknown:
        raise GrammarError(f"{kind} has no parameters {sorted(unknown)}")
