"""XML elements as Mitsuba reads them; numbers are printed so that they read back as the same float64."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.etree import ElementTree

from raytruth.scenes.exporters.comments import one_line

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

    from raytruth.scenes.values import Vector


def add_comment(parent: Element, text: str) -> None:
    """A comment of one line; what XML forbids in comments is replaced, since the text is the scene author's."""
    printable = one_line(text)
    parent.append(ElementTree.Comment(f" {printable.replace('-', '‐') if '--' in printable else printable} "))


def add_numbers(parent: Element, kind: str, **values: float) -> None:
    """Add parameters of one kind, `float` or `integer`, by their names."""
    for name, value in values.items():
        ElementTree.SubElement(parent, kind, name=name, value=repr(value))


def add_text(parent: Element, name: str, value: str) -> None:
    """Add a parameter whose value is a string."""
    ElementTree.SubElement(parent, "string", name=name, value=value)


def add_vector(parent: Element, kind: str, name: str, value: Vector) -> None:
    """Add a parameter that is a `point` or a `vector`."""
    x, y, z = map(repr, value)
    ElementTree.SubElement(parent, kind, name=name, x=x, y=y, z=z)
