"""Renderer adapters, one file a renderer."""
