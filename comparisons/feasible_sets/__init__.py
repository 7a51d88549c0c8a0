"""All that a pixel may be for a renderer that declares an error model."""
