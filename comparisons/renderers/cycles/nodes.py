"""Materials and backgrounds as nodes of Blender; for the child process of the Cycles adapter alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from raytruth.comparisons.renderers.cycles.job import Closure, Texture, Triple

Nodes = Any  # Blender's types are made when it runs

SHADERS = {
    "diffuse": "ShaderNodeBsdfDiffuse",
    "mirror": "ShaderNodeBsdfAnisotropic",  # the glossy one
    "glass": "ShaderNodeBsdfGlass",
    "emission": "ShaderNodeEmission",
}


def add_material(number: int, closures: Sequence[Closure]) -> Any:
    """A material that adds up these terms; without any it is black."""
    material = bpy.data.materials.new(f"material-{number}")
    material.use_nodes = True
    # Emission is met by rays alone: no light is sent to surfaces from it.
    material.cycles.emission_sampling = "NONE"
    tree = material.node_tree
    tree.nodes.clear()
    total = None
    for closure in closures:
        shader = shader_of(tree, closure)
        total = shader if total is None else _linked(tree, "ShaderNodeAddShader", total, shader).outputs[0]
    if total is None:
        black = tree.nodes.new(SHADERS["diffuse"])
        black.inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
        total = black.outputs[0]
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(total, output.inputs["Surface"])
    return material


def shader_of(tree: Nodes, closure: Closure) -> Any:
    """The output of one term's node."""
    node = tree.nodes.new(SHADERS[closure.kind])
    if "Roughness" in node.inputs:
        node.inputs["Roughness"].default_value = 0.0
    if closure.kind in {"mirror", "glass"}:
        node.distribution = "GGX"  # without a factor for light that is scattered more than once
    if closure.kind == "glass":
        node.inputs["IOR"].default_value = closure.index
    if closure.kind == "emission":
        node.inputs["Strength"].default_value = 1.0
    _set_color(tree, node.inputs["Color"], closure.color)
    return node.outputs[0]


def add_world(scene: Any, background: tuple[Triple, Triple] | None) -> None:
    """Make the background: what a ray brings that meets nothing. It is no light that is sent from."""
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.cycles.sampling_method = "NONE"
    tree = scene.world.node_tree
    tree.nodes.clear()
    shader = tree.nodes.new("ShaderNodeBackground")
    bottom, top = background or ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    if bottom == top:
        shader.inputs["Color"].default_value = (*bottom, 1.0)
    else:
        direction = tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"]
        y = _linked(tree, "ShaderNodeSeparateXYZ", direction).outputs["Y"]
        height = _math(tree, "MULTIPLY_ADD", y, 0.5, 0.5)
        tree.links.new(_blend(tree, height, bottom, top), shader.inputs["Color"])
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])


def _set_color(tree: Nodes, socket: Any, texture: Texture) -> None:
    if texture.odd is None:
        socket.default_value = (*texture.even, 1.0)
        return
    point = tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    parts = _linked(tree, "ShaderNodeSeparateXYZ", point).outputs
    floors = []
    for axis, start in zip(texture.axes, texture.offset, strict=True):
        squares = _math(tree, "DIVIDE", _math(tree, "SUBTRACT", parts[axis], start), texture.size)
        floors.append(_math(tree, "FLOOR", squares))
    is_odd = _math(tree, "FLOORED_MODULO", _math(tree, "ADD", *floors), 2.0)
    tree.links.new(_blend(tree, is_odd, texture.even, texture.odd), socket)


def _blend(tree: Nodes, share: Any, first: Triple, second: Triple) -> Any:
    """first·(1 - share) + second·share, which is exact where the share is 0 or 1."""
    of_first = _scaled(tree, _math(tree, "SUBTRACT", 1.0, share), first, (0.0, 0.0, 0.0))
    return _scaled(tree, share, second, of_first)


def _scaled(tree: Nodes, factor: Any, vector: Triple, added: Any) -> Any:
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = "MULTIPLY_ADD"
    return _connected(tree, node, factor, vector, added).outputs[0]


def _math(tree: Nodes, operation: str, *inputs: Any) -> Any:
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    return _connected(tree, node, *inputs).outputs[0]


def _linked(tree: Nodes, kind: str, *inputs: Any) -> Any:
    return _connected(tree, tree.nodes.new(kind), *inputs)


def _connected(tree: Nodes, node: Any, *inputs: Any) -> Any:
    """Each input a number, a triple, or another node's output."""
    for number, value in enumerate(inputs):
        if isinstance(value, float | tuple):
            node.inputs[number].default_value = value
        else:
            tree.links.new(value, node.inputs[number])
    return node
