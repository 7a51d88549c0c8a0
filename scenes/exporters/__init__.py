"""Scenes in the formats of other renderers, one file a format."""
