"""Answers to single steps of a ray tracer, proven, for unit tests in any language."""
