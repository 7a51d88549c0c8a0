"""Renderers whose adapters come with other packages (docs/adapters.md)."""
