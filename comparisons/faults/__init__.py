"""Faults that people make when they write a ray tracer, each with the clause that it breaks, and what must pass."""
